// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "MethodScene.h"
#include "Table.h"

#include <osg/PagedLOD>

#include <GlobeOptions.h>
#include <chrono>
#include <cstddef>
#include <deque>
#include <vector>

namespace osgAnalyticBin::scale {

/// A procedural globe, culled by one method without a window.
class ScaleScene {
public:
    ScaleScene(const bench::CullMethod& method, const globe::GlobeOptions& options, bench::FileWatch& watch);

    /// Stands at a pose until all that it asks for is loaded. Throws: Failure.
    void settle(const flight::CameraPose& pose);
    /// Loads tiles of the hemisphere away from the eye, coarse ones first, until there are that many PagedLODs in all.
    /// Requires: settle(). Throws: Failure when the globe has no more.
    void fill(std::size_t pagedLods);
    /// Repeats from now on, without a test, what the method decides at the pose. Requires: settle(). No more tiles are
    /// loaded; settle() anew begins with the root file.
    void replay();

    /// Adds to "tested_tiles", "kept_tiles" and "drawn_tiles".
    void addCounts(report::Json& row);
    /// Milliseconds of one cull traversal and its sorting.
    [[nodiscard]] double cullMs();
    /// Milliseconds of one update traversal.
    [[nodiscard]] double updateMs();

    [[nodiscard]] osg::Node& root() { return _scene.root(); }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return _scene.frameStamp(); }
    [[nodiscard]] const bench::CullMethod& method() const { return _scene.method(); }
    [[nodiscard]] std::size_t pagedLods();

private:
    void load();
    void nextFrame();

    bench::Settings _settings;
    bench::MethodScene _scene;
    std::deque<osg::ref_ptr<osg::PagedLOD>> _frontier;
    bool _isReplaying = false;
    osg::ref_ptr<flight::RequestCounter> _deaf;
    flight::CullStage _stage;
};

/// Milliseconds since it was made.
class Stopwatch {
public:
    [[nodiscard]] double ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - _begin).count();
    }

private:
    std::chrono::steady_clock::time_point _begin = std::chrono::steady_clock::now();
};

/// Of some times: the first quartile, since what else the machine does only adds to them, and the distance from there
/// to the third.
struct Timing {
    double ms = 0.0;
    double spread = 0.0;
};

/// Requires: at least one.
[[nodiscard]] Timing timingOf(std::vector<double> values);

/// Measures every scene in turn, each round starting with another one: one measurement that is not counted, then
/// three that are. Returns: one result for each scene.
template <class Scenes, class Measure>
[[nodiscard]] std::vector<Timing> measuredInTurns(const Scenes& scenes, int rounds, const Measure& measure) {
    constexpr int kTimedPerTurn = 3;
    std::vector<std::vector<double>> times(scenes.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const std::size_t at = (i + static_cast<std::size_t>(round)) % scenes.size();
            (void)measure(*scenes[at]);
            for (int k = 0; k < kTimedPerTurn; ++k) times[at].push_back(measure(*scenes[at]));
        }
    }
    std::vector<Timing> result;
    for (std::vector<double>& values : times) result.push_back(timingOf(std::move(values)));
    return result;
}

}  // namespace osgAnalyticBin::scale

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraView.h"
#include "CullStage.h"
#include "Settings.h"

#include <osg/Camera>
#include <osg/PagedLOD>

#include <GlobeOptions.h>
#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::scale {

/// Reads what PagedLODs ask for at once, in the thread that calls load().
class TileLoader : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    void requestNodeFile(const std::string& fileName, osg::NodePath& nodePath, float priority,
                         const osg::FrameStamp* frameStamp, osg::ref_ptr<osg::Referenced>& request,
                         const osg::Referenced* options) override;

    /// Merges everything asked for since the last call, and counts the PagedLODs that came.
    /// Returns: whether anything was asked for. Throws: Failure.
    bool load(std::size_t& pagedLods);

private:
    std::vector<osg::ref_ptr<osg::PagedLOD>> _pending;
};

/// Reads the finer children of a PagedLOD and merges them as the DatabasePager does.
/// Returns: the PagedLODs among them. Throws: Failure.
std::vector<osg::ref_ptr<osg::PagedLOD>> loadChildren(osg::PagedLOD& node);

/// What a cull traversal found.
struct TileTally {
    std::uint64_t tested = 0;
    std::uint64_t kept = 0;
    std::uint64_t drawn = 0;
    std::uint64_t leaves = 0;  ///< drawn tiles of the deepest level

    void add(const TileTally& other);
};

/// A procedural globe, culled by one method without a window: tiles are loaded in the calling thread.
class ScaleScene {
public:
    /// Throws: Failure when the globe cannot be read.
    ScaleScene(const ScaleMethod& method, const globe::GlobeOptions& options);
    ScaleScene(const ScaleScene&) = delete;
    ScaleScene& operator=(const ScaleScene&) = delete;

    /// Stands at a pose until all that it asks for is loaded. Throws: Failure.
    void settle(const flight::CameraPose& pose);

    /// Loads tiles of the hemisphere away from the eye, coarse ones first, until there are that many PagedLODs in all.
    /// Requires: settle(). Throws: Failure when the globe has no more.
    void fill(std::size_t pagedLods);

    /// Repeats from now on, without a test, what the method decides at the pose. Requires: settle(), and that no more
    /// tiles are loaded; settle() anew begins with the root file.
    void replay();

    [[nodiscard]] TileTally tally();

    /// Milliseconds of one cull traversal and its sorting.
    [[nodiscard]] double cullMs();

    /// Milliseconds of one update traversal.
    [[nodiscard]] double updateMs();

    [[nodiscard]] osg::Group& root() { return *_root; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_frameStamp; }
    [[nodiscard]] const ScaleMethod& method() const { return _method; }
    [[nodiscard]] std::size_t pagedLods() const { return _pagedLods; }

private:
    void readRoot();
    void nextFrame();
    [[nodiscard]] bool loadAndUpdate();

    ScaleMethod _method;
    globe::GlobeOptions _options;
    osg::ref_ptr<osg::Group> _root;
    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<osg::FrameStamp> _frameStamp;
    flight::Globe _globe;
    osg::Vec3d _eyeEcef;
    std::size_t _pagedLods = 0;
    std::deque<osg::ref_ptr<osg::PagedLOD>> _frontier;
    bool _isFilling = false;
    bool _isReplaying = false;
    osg::ref_ptr<TileLoader> _loader;
    osg::ref_ptr<osg::NodeVisitor::DatabaseRequestHandler> _deaf;
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

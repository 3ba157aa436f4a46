// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTimer.h"

#include "CullStage.h"

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

constexpr int kUntimedPerTurn = 2;
constexpr int kTimedPerTurn = 3;

/// The traversals of one scene, as those of a viewer that stands still.
class Turns {
public:
    explicit Turns(MethodScene& scene)
        : _scene(scene),
          _frameStamp(new osg::FrameStamp(scene.frameStamp())),
          // A file asked for here would be read behind the benchmark's back.
          _requests(new flight::RequestCounter) {}

    void take() {
        // Where a visitor's memory happens to lie costs some percent: each turn has another one.
        CullStage stage(*_requests);
        for (int i = 0; i < kUntimedPerTurn; ++i) (void)nextMs(stage);
        for (int i = 0; i < kTimedPerTurn; ++i) _times.push_back(nextMs(stage));
    }

    [[nodiscard]] CullTime result() const {
        std::vector<double> sorted = _times;
        std::sort(sorted.begin(), sorted.end());
        const auto at = [&](std::size_t part) { return sorted[(sorted.size() - 1) * part / 4]; };
        return {at(2), at(3) - at(1)};
    }

private:
    // Frames are numbered on: what is done every so many frames has its share in every run.
    double nextMs(CullStage& stage) {
        _frameStamp->setFrameNumber(_frameStamp->getFrameNumber() + 1);
        return stage.cull(_scene.camera(), *_frameStamp);
    }

    MethodScene& _scene;
    osg::ref_ptr<osg::FrameStamp> _frameStamp;
    osg::ref_ptr<flight::RequestCounter> _requests;
    std::vector<double> _times;
};

}  // namespace

std::vector<CullTime> cullTimes(const std::vector<std::unique_ptr<MethodScene>>& scenes, int rounds) {
    std::vector<Turns> stages;
    for (const auto& scene : scenes) stages.emplace_back(*scene);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < stages.size(); ++i)
            stages[(i + static_cast<std::size_t>(round)) % stages.size()].take();
    }
    std::vector<CullTime> times;
    for (const Turns& stage : stages) times.push_back(stage.result());
    return times;
}

}  // namespace osgAnalyticBin::bench

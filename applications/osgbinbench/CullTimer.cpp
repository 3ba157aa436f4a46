// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTimer.h"

#include "CullWatcher.h"

#include <algorithm>
#include <chrono>

namespace osgAnalyticBin::bench {

namespace {

constexpr int kTimedPerTurn = 3;

/// What osgUtil::SceneView keeps from frame to frame for its cull stage.
class CullStage {
public:
    explicit CullStage(MethodScene& scene)
        : _scene(scene),
          _visitor(new osgUtil::CullVisitor),
          _stateGraph(new osgUtil::StateGraph),
          _stage(new osgUtil::RenderStage) {
        // A file asked for here would be read behind the viewer's back.
        _visitor->setDatabaseRequestHandler(new flight::RequestCounter);
    }

    [[nodiscard]] double cullMs() {
        _visitor->reset();
        _stateGraph->clean();
        _stage->reset();
        const auto begin = std::chrono::steady_clock::now();
        flight::cullScene(*_visitor, _scene.camera(), _scene.frameStamp(), *_stateGraph, *_stage);
        _stage->sort();
        _stateGraph->prune();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    }

    void takeTurn() {
        (void)cullMs();
        for (int i = 0; i < kTimedPerTurn; ++i) _times.push_back(cullMs());
    }

    [[nodiscard]] CullTime result() const {
        std::vector<double> sorted = _times;
        std::sort(sorted.begin(), sorted.end());
        const auto at = [&](std::size_t part) { return sorted[(sorted.size() - 1) * part / 4]; };
        return {at(2), at(3) - at(1)};
    }

private:
    MethodScene& _scene;
    osg::ref_ptr<osgUtil::CullVisitor> _visitor;
    osg::ref_ptr<osgUtil::StateGraph> _stateGraph;
    osg::ref_ptr<osgUtil::RenderStage> _stage;
    std::vector<double> _times;
};

}  // namespace

std::vector<CullTime> cullTimes(const std::vector<std::unique_ptr<MethodScene>>& scenes, int rounds) {
    std::vector<CullStage> stages;
    for (const auto& scene : scenes) stages.emplace_back(*scene);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < stages.size(); ++i)
            stages[(i + static_cast<std::size_t>(round)) % stages.size()].takeTurn();
    }
    std::vector<CullTime> times;
    for (const CullStage& stage : stages) times.push_back(stage.result());
    return times;
}

}  // namespace osgAnalyticBin::bench

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "Failure.h"
#include "Series.h"

#include <osgDB/DatabasePager>

#include <iostream>
#include <limits>
#include <memory>

namespace osgAnalyticBin::scale {

namespace {

using support::kRadiansPerDegree;

// Deep enough for a million tiles on half of the globe, with meshes as small as they get.
globe::GlobeOptions smallMeshes() {
    globe::GlobeOptions options;
    options.levels = 9;
    options.cells = 2;
    return options;
}

// From 1000 km up, obliquely.
flight::CameraPose view() {
    return {"resident",
            {46.0 * kRadiansPerDegree, 10.0 * kRadiansPerDegree, 1e6},
            {52.0 * kRadiansPerDegree, 10.0 * kRadiansPerDegree, 0.0},
            30.0 * kRadiansPerDegree,
            1e4,
            1e8};
}

class ExpiryRaiser : public osg::NodeVisitor {
public:
    ExpiryRaiser() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    using osg::NodeVisitor::apply;
    void apply(osg::PagedLOD& node) override {
        constexpr double kNever = 1e9;
        for (unsigned int i = 0; i < node.getNumMinimumExpiryTimes(); ++i) node.setMinimumExpiryTime(i, kNever);
        traverse(node);
    }
};

// The DatabasePager's part of a frame's update, without its threads.
class PagerUpdate {
public:
    explicit PagerUpdate(ScaleScene& scene) : _scene(scene), _pager(new osgDB::DatabasePager) {
        // walked over, but not thrown away
        ExpiryRaiser raiser;
        scene.root().accept(raiser);
        _pager->registerPagedLODs(&scene.root(), scene.frameStamp().getFrameNumber());
    }

    void setTarget(unsigned int pagedLods) { _pager->setTargetMaximumNumberOfPageLOD(pagedLods); }

    [[nodiscard]] double ms() {
        const Stopwatch watch;
        _pager->updateSceneGraph(_scene.frameStamp());
        return watch.ms();
    }

private:
    ScaleScene& _scene;
    osg::ref_ptr<osgDB::DatabasePager> _pager;
};

}  // namespace

std::vector<ResidentRow> measureResidents(const Settings& settings) {
    std::vector<std::unique_ptr<ScaleScene>> scenes;
    std::vector<std::unique_ptr<PagerUpdate>> pagers;
    std::vector<ResidentRow> rows;
    for (const int residents : settings.residents) {
        std::cerr << "osgbinbench scale: loading " << residents << " PagedLODs" << std::endl;
        for (const ScaleMethod& method : settings.methods) {
            ScaleScene& scene = *scenes.emplace_back(std::make_unique<ScaleScene>(method, smallMeshes()));
            scene.settle(view());
            scene.fill(static_cast<std::size_t>(residents));
            pagers.push_back(std::make_unique<PagerUpdate>(scene));
            ResidentRow row;
            row.pagedLods = scene.pagedLods();
            row.method = method.name;
            if (method.replaysVerdicts) scene.replay();
            row.tiles = scene.tally();
            rows.push_back(row);
        }
    }
    std::cerr << "osgbinbench scale: residents, timing" << std::endl;
    const auto cull = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.cullMs(); });
    const auto update = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.updateMs(); });
    const auto pagerMs = [&](unsigned int target) {
        for (const auto& pager : pagers) pager->setTarget(target);
        return measuredInTurns(pagers, settings.rounds, [](PagerUpdate& pager) { return pager.ms(); });
    };
    const auto idle = pagerMs(std::numeric_limits<unsigned int>::max());
    const auto full = pagerMs(0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].cullMs = cull[i].ms;
        rows[i].cullSpreadMs = cull[i].spread;
        rows[i].updateMs = update[i].ms;
        rows[i].pagerIdleMs = idle[i].ms;
        rows[i].pagerFullMs = full[i].ms;
    }
    return rows;
}

}  // namespace osgAnalyticBin::scale

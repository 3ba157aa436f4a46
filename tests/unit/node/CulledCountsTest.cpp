// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Statistics count what became of a tile, not what its bin alone said: tiles that are culled as small features or
// behind occluders are outside. Oracle: the tiles that the traversal reached. The counters' own life is tested in
// AnalyticBinCullCallbackTest.cpp.

#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>

#include <gtest/gtest.h>
#include <osg/ConvexPlanarOccluder>
#include <osg/OccluderNode>

namespace osgAnalyticBin::test {
namespace {

constexpr double kGlobeRadius = 6.4e6;

class CulledCounts : public ::testing::Test {
protected:
    void SetUp() override {
        const std::vector<AnalyticBin> bins = startTiles();
        _tiles = static_cast<std::uint32_t>(bins.size());
        for (std::size_t i = 0; i < bins.size(); ++i) _scene->addChild(makeTile(std::to_string(i), bins[i], _visited));
        _view.projection = osg::Matrixd::perspective(50.0, 1.0, 1e5, 1e8);
    }

    BinCounts counted() {
        _visited.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        visitor->setSmallFeatureCullingPixelSize(_pixels);
        cull(*_scene, _view, *visitor);
        const BinCounts counts = BinStatistics::of(*visitor).getCounts();
        EXPECT_EQ(counts.tested, _tiles);
        EXPECT_EQ(counts.inside + counts.straddling, _visited.size());
        EXPECT_EQ(counts.outside, _tiles - _visited.size());
        return counts;
    }

    const osg::ref_ptr<osg::Group> _scene = new osg::Group;
    std::set<std::string> _visited;
    std::uint32_t _tiles = 0;
    CullView _view = CullView::lookAt({5 * kGlobeRadius, 0, 0}, {0, 0, 0}, {0, 0, 1}, 50.0);
    float _pixels = 2.0F;
};

TEST_F(CulledCounts, SmallFeaturesAreOutside) {
    const BinCounts all = counted();
    ASSERT_GT(all.inside, 0U);
    _view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    EXPECT_EQ(counted().outside, all.outside) << "none is smaller than two pixels";
    int partly = 0;
    for (_pixels = 20.0F; _pixels < 200.0F; _pixels += 5.0F) {
        const BinCounts counts = counted();
        if (counts.outside > all.outside && counts.outside < _tiles) ++partly;
    }
    EXPECT_GT(partly, 2);
    _pixels = 1e6F;
    EXPECT_EQ(counted().outside, _tiles);
}

// A wall before the middle of the globe.
osg::ref_ptr<osg::OccluderNode> makeWall() {
    const osg::ref_ptr<osg::ConvexPlanarOccluder> wall = new osg::ConvexPlanarOccluder;
    for (const auto& [y, z] : {std::pair{-0.45, -0.45}, {0.45, -0.45}, {0.45, 0.45}, {-0.45, 0.45}})
        wall->getOccluder().add(osg::Vec3(osg::Vec3d(3.0, y, z) * kGlobeRadius));
    osg::ref_ptr<osg::OccluderNode> occluder = new osg::OccluderNode;
    occluder->setOccluder(wall);
    occluder->setCullingActive(false);
    return occluder;
}

TEST_F(CulledCounts, TilesBehindOccludersAreOutside) {
    _scene->addChild(makeWall());
    const BinCounts all = counted();
    _view.cullingMode |= osg::CullSettings::SHADOW_OCCLUSION_CULLING;
    const BinCounts behind = counted();
    EXPECT_GT(behind.outside, all.outside + 4);
    EXPECT_LT(behind.outside, _tiles);
}

// A fault that no test noticed.
TEST_F(CulledCounts, WhatIsBelowAnOccluderIsNotHiddenByIt) {
    const osg::ref_ptr<osg::OccluderNode> wall = makeWall();
    _scene->addChild(wall);
    (void)counted();
    const std::set<std::string> inView = _visited;
    _view.cullingMode |= osg::CullSettings::SHADOW_OCCLUSION_CULLING;
    (void)counted();
    const std::vector<AnalyticBin> bins = startTiles();
    std::size_t hidden = 0;
    while (hidden < bins.size() &&
           (inView.count(std::to_string(hidden)) == 0 || _visited.count(std::to_string(hidden))))
        ++hidden;
    ASSERT_LT(hidden, bins.size());
    wall->addChild(makeTile("below", bins[hidden], _visited));
    ++_tiles;
    (void)counted();
    EXPECT_EQ(_visited.count("below"), 1U);
}

}  // namespace
}  // namespace osgAnalyticBin::test

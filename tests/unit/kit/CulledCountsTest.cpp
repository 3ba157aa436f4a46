// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Statistics count what became of a tile, not what its bin alone said: tiles that are culled as small features or
// behind occluders are outside. Oracle: the tiles that the traversal reached. The counters' own life is tested in
// AnalyticBinCullCallbackTest.cpp.

#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace osgAnalyticBin::test

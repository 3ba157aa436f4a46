// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles behind a ridge. Pictures and random scenes: tests/scenes. What the core proves: HorizonBufferTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osgUtil/UpdateVisitor>

#include <functional>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

CullOptions withOcclusion() {
    CullOptions options;
    options.occlusion = true;
    return options;
}

// A globe of 32 tiles, of which one has a row of tiles of 0.2 degrees along the equator: a plain, and in the third tile
// a ridge, which tile 4 lies behind. The eye is above the middle of tile 0.
struct RidgeGlobe : MeshGlobe {
    explicit RidgeGlobe(double ridgeHeight = 8000.0) {
        root->removeChild(tiles[20]);
        const auto add = [this](double south, double north, double west, double east, double height) {
            row.push_back(makePaged(makeMeshTile(extentsDeg(south, north, west, east), height), "no.osgb"));
            root->addChild(row.back());
        };
        for (int i = 0; i < 10; ++i) add(0, 0.2, 0.2 * i, 0.2 * i + 0.2, i == 2 ? ridgeHeight : 0.0);
        add(0, 0.2, 2, 45, 0.0);
        add(0.2, 45, 0, 45, 0.0);
    }

    [[nodiscard]] static CullView alongRow(double altitude = 1000.0) {
        return CullView::lookAt(ecefDeg(0.1, 0.1, altitude), ecefDeg(0.1, 1.0, altitude), {1, 0, 0}, 30.0);
    }
    [[nodiscard]] bool drawsFarTile(const CullView& view = alongRow()) { return draws(*row[4], view); }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }

    std::vector<osg::ref_ptr<osg::PagedLOD>> row;
};

TEST(TerrainOcclusion, HidesWhatIsBehindARidge) {
    RidgeGlobe globe;
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsFarTile());
    EXPECT_EQ(globe.counts().occluded, 0u);
    setCullOptions(*globe.root, withOcclusion());
    EXPECT_FALSE(globe.drawsFarTile());
    EXPECT_GE(globe.counts().occluded, 1u);
    EXPECT_GE(globe.counts().outside, globe.counts().occluded);
    for (const int i : {0, 1, 2})
        EXPECT_TRUE(globe.draws(*globe.row[static_cast<std::size_t>(i)], globe.alongRow())) << i;
    // from above the ridge, and from above a lower one
    EXPECT_TRUE(
        globe.drawsFarTile(CullView::lookAt(ecefDeg(0.1, 0.1, 40000.0), ecefDeg(0.1, 0.9, 0.0), {1, 0, 0}, 30.0)));
    RidgeGlobe low(500.0);
    installBins(*low.root, withOcclusion());
    EXPECT_TRUE(low.drawsFarTile());
}

TEST(TerrainOcclusion, IsTheSameWhenTilesAreTestedOneByOne) {
    RidgeGlobe globe;
    installBins(*globe.root, withOcclusion());
    BinStatistics::of(*globe.visitor).setTileByTile(true);
    EXPECT_FALSE(globe.drawsFarTile());
    EXPECT_GE(globe.counts().occluded, 1u);
}

TEST(TerrainOcclusion, NeedsARidgeThatIsDrawnAsItWas) {
    const auto mask = [](RidgeGlobe& globe) { drawableOf(*globe.row[2])->setNodeMask(0); };
    const auto remove = [](RidgeGlobe& globe) { globe.root->removeChild(globe.row[2]); };
    const auto outline = [](RidgeGlobe& globe) {
        globe.row[2]->getOrCreateStateSet()->setAttributeAndModes(
            new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
    };
    const auto flatten = [](RidgeGlobe& globe) {
        const osg::ref_ptr<osg::MatrixTransform> flat = makeMeshTile(extentsDeg(0, 0.2, 0.4, 0.6), 0.0);
        globe.row[2]->replaceChild(globe.row[2]->getChild(0), flat);
    };
    const auto lower = [](RidgeGlobe& globe) {
        auto* const transform = globe.row[2]->getChild(0)->asTransform()->asMatrixTransform();
        transform->setMatrix(transform->getMatrix() * osg::Matrixd::translate(-8000.0, 0.0, 0.0));
    };
    const auto lowerVertices = [](RidgeGlobe& globe) {
        osg::Geometry& geometry = *drawableOf(*globe.row[2])->asGeometry();
        auto& vertices = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
        for (osg::Vec3& v : vertices) v.x() -= 8000.0F;
        vertices.dirty();
        geometry.dirtyBound();
    };
    const std::vector<std::function<void(RidgeGlobe&)>> ways{mask, remove, outline, flatten, lower, lowerVertices};
    for (std::size_t i = 0; i < ways.size(); ++i) {
        RidgeGlobe globe;
        installBins(*globe.root, withOcclusion());
        EXPECT_FALSE(globe.drawsFarTile());
        ways[i](globe);
        EXPECT_TRUE(globe.drawsFarTile()) << i;
        update(*globe.root);
        EXPECT_TRUE(globe.drawsFarTile()) << i;
    }
}

TEST(TerrainOcclusion, NeedsAnEyeThatSeesTheGroundInFront) {
    RidgeGlobe globe;
    installBins(*globe.root, withOcclusion());
    EXPECT_FALSE(globe.drawsFarTile());
    CullView parallel = RidgeGlobe::alongRow();
    parallel.projection = osg::Matrixd::ortho(-2e4, 2e4, -2e4, 2e4, 1.0, 1e8);
    EXPECT_TRUE(globe.drawsFarTile(parallel));
    EXPECT_TRUE(globe.drawsFarTile(RidgeGlobe::alongRow(-200.0)));
    // the near plane cuts the ridge, or the plain in front of it, away
    CullView cutting = RidgeGlobe::alongRow();
    cutting.projection = osg::Matrixd::perspective(30.0, 1.0, 60000.0, 1e8);
    EXPECT_TRUE(globe.drawsFarTile(cutting));
    cutting.projection = osg::Matrixd::perspective(30.0, 1.0, 8000.0, 1e8);
    EXPECT_TRUE(globe.drawsFarTile(cutting));
    cutting.projection = osg::Matrixd::perspective(30.0, 1.0, 2000.0, 1e8);
    EXPECT_FALSE(globe.drawsFarTile(cutting));
    // where OSG computes it, it may be at a part of the distance to the far end of the database
    CullView computed = RidgeGlobe::alongRow();
    computed.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
    globe.visitor->setNearFarRatio(1e-6);
    EXPECT_FALSE(globe.drawsFarTile(computed));
    globe.visitor->setNearFarRatio(0.2);
    EXPECT_TRUE(globe.drawsFarTile(computed));
}

TEST(TerrainOcclusion, IsOffWithoutAHorizon) {
    for (const bool isOff : {false, true}) {
        RidgeGlobe globe;
        CullOptions options = withOcclusion();
        if (isOff) options.horizonUse = HorizonUse::Off;
        // a globe with a hole
        if (!isOff) globe.root->removeChild(globe.tiles[3]);
        installBins(*globe.root, options);
        EXPECT_TRUE(globe.drawsFarTile()) << isOff;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

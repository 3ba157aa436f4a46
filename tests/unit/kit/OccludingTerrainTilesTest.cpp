// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgTerrain tiles that hide others. Which do, and what ends it: tests/scenes/ridge-*.scene, terrain-*.scene. Meshes:
// TerrainOcclusionTest.cpp.

#include "KitTest.h"
#include "RidgeGlobe.h"

namespace osgAnalyticBin::test {
namespace {

using osgTerrain::TerrainTile;

osg::ref_ptr<TerrainTile> makePlain(double south, double north, double west, double east, unsigned int posts,
                                    float height = 0.0f) {
    return makeTerrainTile(extentsDeg(south, north, west, east), posts, posts,
                           [height](unsigned int, unsigned int) { return height; });
}

// A globe of osgTerrain tiles. Along the equator stand tiles of 0.2 degrees: a plain, and in the third tile a ridge,
// which tile 4 lies behind. The eye is above the middle of tile 0.
struct TerrainGlobe {
    explicit TerrainGlobe(float heightOfFarTile = 0.0f) {
        terrain->setEllipsoidModel(new osg::EllipsoidModel);
        for (int i = 0; i < 32; ++i) {
            const double south = -90.0 + 45.0 * (i / 8), west = -180.0 + 45.0 * (i % 8);
            if (i != 20) terrain->addChild(makePlain(south, south + 45.0, west, west + 45.0, 65));
        }
        terrain->addChild(makePlain(0.2, 45.0, 0.0, 45.0, 65));
        for (int i = 0; i < 225; ++i) {
            row.push_back(makePlain(0.0, 0.2, 0.2 * i, 0.2 * i + 0.2, 9,
                                    i == 2   ? 8000.0f
                                    : i == 4 ? heightOfFarTile
                                             : 0.0f));
            terrain->addChild(row.back());
        }
    }

    [[nodiscard]] bool drawsFarTile(double nearPlane = 1.0) {
        CullView view = CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), ecefDeg(0.1, 1.0, 1000.0), {1, 0, 0}, 30.0);
        view.projection = osg::Matrixd::perspective(30.0, 1.0, nearPlane, 1e8);
        update(*terrain);
        return cull(*terrain, view, *visitor, ++frame).drawn.count(drawableOf(*row[4])) > 0;
    }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }

    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    std::vector<osg::ref_ptr<TerrainTile>> row;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

TEST(OccludingTerrainTiles, GetTheirPlatesInUpdatesWhereTheyAreLeftToThemselves) {
    TerrainGlobe globe;
    installBins(*globe.terrain, withOcclusion(OcclusionUse::Auto));
    int awaited = 0;
    for (; awaited < 100 && globe.drawsFarTile(); ++awaited) continue;
    EXPECT_GE(awaited, 1);
    EXPECT_LT(awaited, 100);
}

// With a technique that the application vouches for, the horizon is used if the eye is surely above what is drawn. A
// ridge hides nothing, because nobody knows its exact height.
TEST(OccludingTerrainTiles, OfATechniqueThatIsVouchedForAreTheHorizonAlone) {
    struct OtherTechnique : osgTerrain::GeometryTechnique {};
    TerrainGlobe globe;
    globe.terrain->setTerrainTechniquePrototype(new OtherTechnique);
    CullOptions options = withOcclusion(OcclusionUse::On);
    installBins(*globe.terrain, options);
    const auto hiddenFrom = [&](double longitude, double altitude) {
        const auto view = CullView::lookAt(ecefDeg(0.107, longitude, altitude), ecefDeg(0.107, longitude + 0.1, 0.0),
                                           {1, 0, 0}, 60.0);
        for (int i = 0; i < 2; ++i) {
            update(*globe.terrain);
            (void)cull(*globe.terrain, view, *globe.visitor, ++globe.frame);
        }
        return globe.counts().hidden;
    };
    EXPECT_EQ(hiddenFrom(0.507, 9000.0), 0u);
    options.techniqueMargin = 300.0;
    setCullOptions(*globe.terrain, options);
    EXPECT_GT(hiddenFrom(0.507, 8310.0), 0u);
    EXPECT_EQ(hiddenFrom(0.507, 8290.0), 0u);
    // the ridge ends at 0.6 degrees, and may overhang the plain by 300 m
    EXPECT_GT(hiddenFrom(0.6 + 350.0 / 111320.0, 500.0), 0u);
    EXPECT_EQ(hiddenFrom(0.6 + 290.0 / 111320.0, 500.0), 0u);
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile());
}

// Through a plain that is cut away, the eye sees past the foot of the ridge into a pit.
TEST(OccludingTerrainTiles, HideNothingWhereTheNearPlaneCutsThemAway) {
    TerrainGlobe globe(-15000.0f);
    // with bins as deep as the pit, so that nothing but the near plane shows it
    for (std::size_t i = 0; i < 10; ++i) {
        const double west = 0.2 * static_cast<double>(i);
        setStoredBin(*globe.row[i],
                     AnalyticBin(extentsDeg(0.0, 0.2, west, west + 0.2).withAltitude({-2e4, 9e3}), 10.0));
    }
    installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
    EXPECT_FALSE(globe.drawsFarTile());
    EXPECT_FALSE(globe.drawsFarTile(500.0));
    EXPECT_TRUE(globe.drawsFarTile(6000.0));
    EXPECT_TRUE(globe.drawsFarTile(60000.0));
}

}  // namespace
}  // namespace osgAnalyticBin::test

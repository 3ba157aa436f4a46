// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The census of the synthetic globe's root file, whose tiles are known; no window is needed.

#include "TileCensus.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>

#include <support/GridMesh.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::flight {
namespace {

Census censusOf(osg::Node& scene) {
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewport(new osg::Viewport(0, 0, 320, 240));
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setCullingMode(osg::CullSettings::NO_CULLING);
    camera->setViewMatrixAsLookAt(osg::Vec3d(5e7, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera->setProjectionMatrixAsPerspective(40, 4.0 / 3.0, 1e6, 1e8);
    camera->addChild(&scene);
    const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
    return TileCensus::take(*camera, *frameStamp);
}

TEST(TileCensus, CountsTheTilesOfTheGlobeAndKnowsTheBinsThatTheKitInstalled) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> globe = osgDB::readRefNodeFile(test::writeSyntheticDatabase(folder.path()));
    ASSERT_TRUE(globe.valid());
    const Census census = censusOf(*globe);
    for (const std::uint64_t count :
         {census.tested, census.kept, census.drawn, census.pagedLods, residentTiles(*globe)})
        EXPECT_EQ(count, 32U);
    EXPECT_EQ(census.tiles.size(), 32U);
    EXPECT_EQ(census.keys().size(), 32U);
    EXPECT_EQ(census.triangles, 32U * 512U);
    EXPECT_EQ(census.wanted, 0U);
    EXPECT_EQ(census.nodes, 1U + 32U * 4U);  // each tile: PagedLOD, transform, geode, geometry
    for (const DrawnTile& tile : census.tiles) EXPECT_FALSE(tile.bin.valid()) << tile.key;

    CullOptions options;
    options.horizonUse = HorizonUse::Off;
    ASSERT_EQ(installBins(*globe, options), 32U);
    const Census withBins = censusOf(*globe);
    ASSERT_EQ(withBins.tiles.size(), 32U);
    double area = 0.0;
    for (const DrawnTile& tile : withBins.tiles) {
        ASSERT_TRUE(tile.bin.valid()) << tile.key;
        area += tile.bin.bin().latitude().width() * tile.bin.bin().longitude().width();
        EXPECT_LT(tile.bin.bin().altitude().upper, 3100.0) << tile.key;
    }
    // They cover the globe, and hardly overlap.
    constexpr double kGlobe = 2.0 * 3.14159265358979 * 3.14159265358979;
    EXPECT_GE(area, kGlobe * (1.0 - 1e-9));
    EXPECT_LT(area, kGlobe * 1.005);
}

osg::ref_ptr<osg::Geometry> triangle() {
    const osg::Vec3 corners[] = {{6.4e6F, 0, 0}, {6.4e6F, 1e5F, 0}, {6.4e6F, 0, 1e5F}};
    return test::makeGeometry(new osg::Vec3Array(3, corners), new osg::DrawArrays(GL_TRIANGLES, 0, 3));
}

TEST(TileCensus, TakesTheBinThatIsShown) {
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(triangle(), 0.0F, 1e10F);
    const AnalyticBin bin(core::GeodeticBin::fromDegrees({-1, 2}, {-1, 2}, {-100, 2000}));
    const osg::ref_ptr<AnalyticBinCullCallback> callback =
        new AnalyticBinCullCallback(bin, osg::EllipsoidModel(), CullOptions());
    TerrainShape shape;
    shape.verticalScale = 3.0;
    callback->setTerrainShape(shape);
    callback->setSkirt(50.0);
    lod->setCullCallback(new osg::NodeCallback);
    lod->addCullCallback(callback);  // nested
    const Census census = censusOf(*lod);
    ASSERT_EQ(census.tiles.size(), 1U);
    EXPECT_NEAR(census.tiles[0].bin.bin().altitude().upper, 6000.0, 1e-6);
    EXPECT_NEAR(census.tiles[0].bin.bin().altitude().lower, -350.0, 1e-6);
}

TEST(TileCensus, TakesALeafOnAPageForATile) {
    const osg::ref_ptr<osg::Group> page = new osg::Group;
    page->addChild(test::placed(triangle(), osg::Matrixd::translate(0, 1e5, 0)));
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(triangle(), 1e8F, 1e10F);
    lod->addChild(page, 0.0F, 1e8F);
    lod->setFileName(1, "page.osgb");
    const Census census = censusOf(*lod);
    EXPECT_EQ(census.tested, 2U);
    EXPECT_EQ(census.pagedLods, 1U);
    EXPECT_EQ(residentTiles(*lod), 2U);
    ASSERT_EQ(census.tiles.size(), 1U);
    EXPECT_EQ(census.tiles[0].key, "1");  // a page of one child stands for the child
    ASSERT_EQ(census.tiles[0].meshes.size(), 1U);
    EXPECT_NEAR(census.tiles[0].meshes[0].localToWorld.getTrans().y(), 1e5, 1e-6);
}

}  // namespace
}  // namespace osgAnalyticBin::flight

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The census of the synthetic globe's root file, whose tiles are known; no window is needed.

#include "TileCensus.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>

#include <iterator>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::flight {
namespace {

osg::ref_ptr<osg::Camera> cameraOver(osg::Node& scene) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewport(new osg::Viewport(0, 0, 320, 240));
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setCullingMode(osg::CullSettings::NO_CULLING);
    camera->setViewMatrixAsLookAt(osg::Vec3d(5e7, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera->setProjectionMatrixAsPerspective(40, 4.0 / 3.0, 1e6, 1e8);
    camera->addChild(&scene);
    return camera;
}

TEST(TileCensus, CountsTheTilesOfTheGlobe) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> globe = osgDB::readRefNodeFile(test::writeSyntheticDatabase(folder.path()));
    ASSERT_TRUE(globe.valid());
    const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
    const Census census = TileCensus::take(*cameraOver(*globe), *frameStamp);
    EXPECT_EQ(census.tested, 32U);
    EXPECT_EQ(census.kept, 32U);
    EXPECT_EQ(census.drawn, 32U);
    EXPECT_EQ(census.binsTested, 0U);
    EXPECT_EQ(census.pagedLods, 32U);
    EXPECT_EQ(census.tiles.size(), 32U);
    EXPECT_EQ(census.keys().size(), 32U);
    EXPECT_EQ(census.triangles, 32U * 512U);
    EXPECT_EQ(census.wanted, 0U);
    EXPECT_EQ(census.nodes, 1U + 32U * 4U);  // each tile: PagedLOD, transform, geode, geometry
    EXPECT_EQ(residentTiles(*globe), 32U);
    for (const DrawnTile& tile : census.tiles) EXPECT_FALSE(tile.bin.valid()) << tile.key;
}

TEST(TileCensus, KnowsTheBinsThatTheKitInstalled) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> globe = osgDB::readRefNodeFile(test::writeSyntheticDatabase(folder.path()));
    ASSERT_TRUE(globe.valid());
    CullOptions options;
    options.skirts = SkirtUse::All;
    ASSERT_EQ(installBins(*globe, options), 32U);
    const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
    const Census census = TileCensus::take(*cameraOver(*globe), *frameStamp);
    ASSERT_EQ(census.tiles.size(), 32U);
    EXPECT_EQ(census.binsTested, 32U);
    EXPECT_EQ(census.binsOutside + census.binsInside + census.binsStraddling, 32U);
    double area = 0.0;
    for (const DrawnTile& tile : census.tiles) {
        ASSERT_TRUE(tile.bin.valid()) << tile.key;
        area += tile.bin.bin().latitude().width() * tile.bin.bin().longitude().width();
        EXPECT_LT(tile.bin.bin().altitude().upper, 3100.0) << tile.key;
    }
    // They cover the globe, and hardly overlap.
    constexpr double kGlobe = 2.0 * 3.14159265358979 * 3.14159265358979;
    EXPECT_GE(area, kGlobe * (1.0 - 1e-9));
    EXPECT_LT(area, kGlobe * 1.005);
}

TEST(TileCensus, TakesTheBinThatIsShown) {
    const osg::ref_ptr<osg::Geometry> triangle = new osg::Geometry;
    const osg::Vec3 corners[] = {{6.4e6F, 0, 0}, {6.4e6F, 1e5F, 0}, {6.4e6F, 0, 1e5F}};
    triangle->setVertexArray(new osg::Vec3Array(std::begin(corners), std::end(corners)));
    triangle->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    const osg::ref_ptr<osg::Geode> own = new osg::Geode;
    own->addDrawable(triangle);
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(own, 0.0F, 1e10F);
    const AnalyticBin bin(core::GeodeticBin::fromDegrees({-1, 2}, {-1, 2}, {-100, 2000}));
    const osg::ref_ptr<AnalyticBinCullCallback> callback =
        new AnalyticBinCullCallback(bin, osg::EllipsoidModel(), CullOptions());
    TerrainShape shape;
    shape.verticalScale = 3.0;
    callback->setTerrainShape(shape);
    callback->setSkirt(50.0);
    lod->setCullCallback(new osg::NodeCallback);
    lod->addCullCallback(callback);  // nested
    const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
    const Census census = TileCensus::take(*cameraOver(*lod), *frameStamp);
    ASSERT_EQ(census.tiles.size(), 1U);
    EXPECT_NEAR(census.tiles[0].bin.bin().altitude().upper, 6000.0, 1e-6);
    EXPECT_NEAR(census.tiles[0].bin.bin().altitude().lower, -350.0, 1e-6);
}

TEST(TileCensus, TakesALeafOnAPageForATile) {
    const osg::ref_ptr<osg::Geometry> triangle = new osg::Geometry;
    const osg::Vec3 corners[] = {{6.4e6F, 0, 0}, {6.4e6F, 1e5F, 0}, {6.4e6F, 0, 1e5F}};
    triangle->setVertexArray(new osg::Vec3Array(std::begin(corners), std::end(corners)));
    triangle->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    const osg::ref_ptr<osg::MatrixTransform> leaf = new osg::MatrixTransform(osg::Matrixd::translate(0, 1e5, 0));
    leaf->addChild(triangle);
    const osg::ref_ptr<osg::Group> page = new osg::Group;
    page->addChild(leaf);
    const osg::ref_ptr<osg::Geode> own = new osg::Geode;
    own->addDrawable(triangle);
    const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->addChild(own, 1e8F, 1e10F);
    lod->addChild(page, 0.0F, 1e8F);
    lod->setFileName(1, "page.osgb");
    const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
    const Census census = TileCensus::take(*cameraOver(*lod), *frameStamp);
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

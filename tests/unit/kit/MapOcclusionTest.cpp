// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles behind a ridge of a map. On globes: TerrainOcclusionTest.cpp. What the core proves: HorizonBufferTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "PlanarMap.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgTerrain/Layer>
#include <osgTerrain/Locator>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <support/CapturedNotes.h>
#include <support/GridMesh.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

constexpr unsigned int kPosts = 17;
constexpr double kSize = 20000.0;

// A level tile of triangles about its middle.
osg::ref_ptr<osg::Node> meshTile(const osg::Vec3d& corner, double height) {
    const osg::Vec3d middle = corner + osg::Vec3d(0.5 * kSize, 0.5 * kSize, 0.0);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const double step = kSize / (kPosts - 1);
    for (unsigned int i = 0; i < kPosts * kPosts; ++i)
        vertices->push_back(osg::Vec3d(step * (i % kPosts) - 0.5 * kSize, step * (i / kPosts) - 0.5 * kSize, height));
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, gridTriangles(kPosts));
    const osg::ref_ptr<osg::MatrixTransform> transform = placed(geometry, osg::Matrixd::translate(middle));
    transform->setDataVariance(osg::Object::STATIC);
    return transform;
}

osg::ref_ptr<osg::Node> terrainTile(const osg::Vec3d& corner, double height) {
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setCoordinateSystemType(osgTerrain::Locator::PROJECTED);
    locator->setTransformAsExtents(corner.x(), corner.y(), corner.x() + kSize, corner.y() + kSize);
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(kPosts, kPosts);
    for (unsigned int i = 0; i < kPosts * kPosts; ++i)
        field->setHeight(i % kPosts, i / kPosts, static_cast<float>(height));
    const osg::ref_ptr<osgTerrain::HeightFieldLayer> layer = new osgTerrain::HeightFieldLayer(field);
    layer->setLocator(locator);
    const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    tile->setLocator(locator);
    tile->setElevationLayer(layer);
    return tile;
}

// A row of ten tiles eastward, between two others: a plain, and in the third tile a ridge, which tile 4 lies behind.
// The eye is above the middle of tile 0.
struct RidgeMap : MeshGlobe {
    explicit RidgeMap(double ridge = 8000.0, bool isTerrain = false) {
        root = isTerrain ? new osgTerrain::Terrain : new osg::CoordinateSystemNode;
        root->setFormat("WKT");
        root->setCoordinateSystem(kUtm);
        scene = root;
        for (int i = 0; i < 10; ++i) {
            row.push_back(add(cornerOf(i), i == 2 ? ridge : 0.0, isTerrain));
            for (const double beside : {-kSize, kSize}) add(cornerOf(i) + osg::Vec3d(0.0, beside, 0.0), 0.0, isTerrain);
        }
    }

    osg::ref_ptr<osg::PagedLOD> add(const osg::Vec3d& corner, double height, bool isTerrain) const {
        osg::ref_ptr<osg::PagedLOD> tile =
            makePaged(isTerrain ? terrainTile(corner, height) : meshTile(corner, height), "no.osgb");
        root->addChild(tile);
        return tile;
    }

    [[nodiscard]] static osg::Vec3d cornerOf(int i) { return {500000.0 + kSize * i, 4600000.0, 0.0}; }
    [[nodiscard]] static CullView alongRow(double altitude = 1000.0, double aside = 0.5) {
        const osg::Vec3d eye = cornerOf(0) + osg::Vec3d(0.5 * kSize, aside * kSize, altitude);
        return CullView::lookAt(eye, eye + osg::Vec3d(1e5, 0.0, 0.0), {0, 0, 1}, 30.0);
    }
    [[nodiscard]] bool drawsTile(std::size_t i, const CullView& view = alongRow()) {
        update(*root);
        return cull(*root, view, *visitor, ++frame).drawn.count(drawableOf(*row[i])) > 0;
    }
    [[nodiscard]] bool drawsFarTile(const CullView& view = alongRow()) { return drawsTile(4, view); }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }

    std::vector<osg::ref_ptr<osg::PagedLOD>> row;
};

TEST(MapOcclusion, HidesWhatIsBehindARidge) {
    for (const bool isTerrain : {false, true}) {
        RidgeMap map(8000.0, isTerrain);
        EXPECT_TRUE(map.drawsFarTile());
        installBins(*map.root, optionsOf("heights=-100..9000,occlusion=off"));
        EXPECT_TRUE(map.drawsFarTile());
        EXPECT_EQ(map.counts().occluded, 0u);
        setCullOptions(*map.root, optionsOf("heights=-100..9000,occlusion=on"));
        EXPECT_FALSE(map.drawsFarTile()) << isTerrain;
        EXPECT_GE(map.counts().occluded, 1u);
        for (const std::size_t i : {0u, 1u, 2u}) EXPECT_TRUE(map.drawsTile(i)) << i;
        BinStatistics::of(*map.visitor).setTileByTile(true);
        EXPECT_FALSE(map.drawsFarTile());
        RidgeMap low(500.0, isTerrain);
        installBins(*low.root, optionsOf("heights=-100..9000,occlusion=on"));
        EXPECT_TRUE(low.drawsFarTile());
    }
}

TEST(MapOcclusion, IsNotNeededWhereBoxesEndBelowTheView) {
    for (const bool isTerrain : {false, true}) {
        RidgeMap map(0.0, isTerrain);
        const osg::Vec3d eye = RidgeMap::cornerOf(0) + osg::Vec3d(-kSize, 0.5 * kSize, 2000.0);
        const CullView view = CullView::lookAt(eye, eye + osg::Vec3d(1e5, 0.0, 2000.0), {0, 0, 1}, 2.0);
        installBins(*map.root, optionsOf("heights=-100..900,occlusion=off"));
        EXPECT_FALSE(map.drawsFarTile(view));
        EXPECT_GE(map.counts().outside, map.row.size()) << isTerrain;
    }
}

TEST(MapOcclusion, NeedsAnEyeAboveTheMap) {
    RidgeMap map;
    installBins(*map.root, optionsOf("heights=-100..9000,occlusion=on"));
    EXPECT_FALSE(map.drawsFarTile());
    EXPECT_TRUE(map.drawsFarTile(RidgeMap::alongRow(-200.0))) << "below";
    EXPECT_TRUE(map.drawsFarTile(RidgeMap::alongRow(1000.0, -1.1))) << "beside";
    EXPECT_TRUE(map.drawsFarTile(RidgeMap::alongRow(1000.0, -0.99))) << "within the border";
    EXPECT_TRUE(map.drawsFarTile(RidgeMap::alongRow(20000.0))) << "above the ridge";
    setCullOptions(*map.root, optionsOf("heights=-100..9000,occlusion=on,horizon=off"));
    EXPECT_TRUE(map.drawsFarTile());
    setCullOptions(*map.root, optionsOf("heights=-100..9000,occlusion=on,skirts=all"));
    EXPECT_TRUE(map.drawsFarTile());
}

TEST(MapOcclusion, NeedsAMapWithoutGaps) {
    RidgeMap map;
    map.root->removeChild(map.row[7]);
    installBins(*map.root, optionsOf("heights=-100..9000,occlusion=on"));
    EXPECT_TRUE(map.drawsFarTile());
}

// A row of kilometres is as far from the horizon of a globe as one likes.
TEST(MapOcclusion, HasNoHorizon) {
    RidgeMap map(0.0);
    installBins(*map.root, optionsOf("heights=-100..9000,horizon=-100"));
    EXPECT_TRUE(map.drawsTile(9, RidgeMap::alongRow(2.0)));
    EXPECT_EQ(map.counts().hidden, 0u);
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgTerrain tiles behind a ridge of a map. Meshes: tests/scenes/ridge.scene. On globes: TerrainOcclusionTest.cpp. What
// the core proves: HorizonBufferTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "PlanarMap.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osgTerrain/Layer>
#include <osgTerrain/Locator>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <vector>

namespace osgAnalyticBin::test {
namespace {

constexpr unsigned int kPosts = 17;
constexpr double kSize = 20000.0;

osg::ref_ptr<osg::Node> levelTile(const osg::Vec3d& corner, double height) {
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
    explicit RidgeMap(double ridge) {
        root = new osgTerrain::Terrain;
        root->setFormat("WKT");
        root->setCoordinateSystem(kUtm);
        scene = root;
        for (int i = 0; i < 10; ++i) {
            row.push_back(add(cornerOf(i), i == 2 ? ridge : 0.0));
            for (const double beside : {-kSize, kSize}) add(cornerOf(i) + osg::Vec3d(0.0, beside, 0.0), 0.0);
        }
    }

    osg::ref_ptr<osg::PagedLOD> add(const osg::Vec3d& corner, double height) const {
        osg::ref_ptr<osg::PagedLOD> tile = makePaged(levelTile(corner, height), "no.osgb");
        root->addChild(tile);
        return tile;
    }

    [[nodiscard]] static osg::Vec3d cornerOf(int i) { return {500000.0 + kSize * i, 4600000.0, 0.0}; }
    [[nodiscard]] static CullView alongRow() {
        const osg::Vec3d eye = cornerOf(0) + osg::Vec3d(0.5 * kSize, 0.5 * kSize, 1000.0);
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
    RidgeMap map(8000.0), low(500.0);
    EXPECT_TRUE(map.drawsFarTile());
    installBins(*map.root, optionsOf("heights=-100..9000,occlusion=off"));
    EXPECT_TRUE(map.drawsFarTile());
    EXPECT_EQ(map.counts().occluded, 0u);
    setCullOptions(*map.root, optionsOf("heights=-100..9000,occlusion=on"));
    EXPECT_FALSE(map.drawsFarTile());
    EXPECT_GE(map.counts().occluded, 1u);
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_TRUE(map.drawsTile(i)) << i;
    BinStatistics::of(*map.visitor).setTileByTile(true);
    EXPECT_FALSE(map.drawsFarTile());
    installBins(*low.root, optionsOf("heights=-100..9000,occlusion=on"));
    EXPECT_TRUE(low.drawsFarTile());
}

TEST(MapOcclusion, IsNotNeededWhereBoxesEndBelowTheView) {
    RidgeMap map(0.0);
    const osg::Vec3d eye = RidgeMap::cornerOf(0) + osg::Vec3d(-kSize, 0.5 * kSize, 2000.0);
    const CullView view = CullView::lookAt(eye, eye + osg::Vec3d(1e5, 0.0, 2000.0), {0, 0, 1}, 2.0);
    installBins(*map.root, optionsOf("heights=-100..900,occlusion=off"));
    EXPECT_FALSE(map.drawsFarTile(view));
    EXPECT_GE(map.counts().outside, map.row.size());
}

}  // namespace
}  // namespace osgAnalyticBin::test

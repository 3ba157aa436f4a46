// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// When families of sibling tiles are made anew, and what they are made of. That they are culled as each tile by itself,
// and what is delivered of kept tiles: tests/scenes, tests/long/scenes.

#include "KitTest.h"

#include <osgUtil/Optimizer>

namespace osgAnalyticBin::test {
namespace {

BinCounts countsOf(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    (void)cull(scene, view, *visitor);
    return BinStatistics::of(*visitor).getCounts();
}

// Bins that are stored hold skirts, which lean outwards; the meshes themselves end before.
TEST(TileFamily, FollowsMeshesThatOsgOptimizesWhereAHorizonIsDeclared) {
    MeshGlobe globe;
    constexpr double kLean = 1e-5;  // radians
    for (int i = 0; i < 32; ++i) {
        const core::GeodeticBin own = extentsOfTile(i);
        setStoredBin(*globe.tiles[static_cast<std::size_t>(i)],
                     AnalyticBin({{std::max(own.latitude().lower - kLean, -osg::PI_2),
                                   std::min(own.latitude().upper + kLean, osg::PI_2)},
                                  own.longitude(),
                                  {-49000.0, 1000.0}}));
    }
    installBins(*globe.root, declaredHorizon());
    osgUtil::Optimizer optimizer;
    optimizer.optimize(globe.root.get());
    globe.expectAntipode(false);
    // a mesh that has not moved is still found in its place when it is looked at again
    auto& vertices = verticesOf(*globe.tiles[19]);
    vertices.dirty();
    drawableOf(*globe.tiles[19])->dirtyBound();
    (void)globe.drawsAntipode();
    update(*globe.root);
    globe.expectAntipode(false);
    // and one that becomes narrower leaves a gap
    for (osg::Vec3& vertex : vertices) vertex = vertices.front() + (vertex - vertices.front()) * 0.9F;
    vertices.dirty();
    drawableOf(*globe.tiles[19])->dirtyBound();
    globe.expectAntipode(true);
}

// Vertices may change in each frame: the family is not made anew for that.
TEST(TileFamily, StaysWhereMeshesChange) {
    InstalledGlobe globe;
    const osg::ref_ptr<osg::Callback> last = globe.root->getCullCallback()->getNestedCallback();
    osg::Geometry& geometry = geometryOf(*globe.tiles[19]);
    geometry.getVertexArray()->dirty();
    geometry.dirtyBound();
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    EXPECT_EQ(globe.root->getCullCallback()->getNestedCallback(), last);
}

// Levels of detail among tiles, which count how often they are looked at.
struct CountedLevels : osg::LOD {
    osg::Group* asGroup() override { return this; }
    const osg::Group* asGroup() const override {
        ++looks;
        return this;
    }
    mutable int looks = 0;
};

TEST(TileFamily, IsLookedThroughOnceForManyMeshes) {
    const auto looksFor = [](int changed) {
        MeshGlobe globe;
        const osg::ref_ptr<CountedLevels> levels = new CountedLevels;
        levels->addChild(globe.tiles[31], 0.0f, 1e9f);
        globe.root->removeChild(globe.tiles[31]);
        globe.root->addChild(levels);
        installBins(*globe.root);
        for (int i = 0; i < changed; ++i) {
            osg::Geometry& geometry = geometryOf(*globe.tiles[static_cast<std::size_t>(i)]);
            geometry.getVertexArray()->dirty();
            geometry.dirtyBound();
        }
        (void)globe.root->getBound();
        levels->looks = 0;
        update(*globe.root);
        return levels->looks;
    };
    EXPECT_GT(looksFor(1), 0);
    EXPECT_EQ(looksFor(9), looksFor(1));
}

// Their numbers are others than those that the family was made with, until the next update.
TEST(TileFamily, FollowsTilesThatMove) {
    InstalledGlobe globe;
    const BinCounts before = countsOf(*globe.root, MeshGlobe::fromAbove());
    globe.root->insertChild(0, new osg::Group);
    for (int i = 0; i < 2; ++i) {
        const BinCounts after = countsOf(*globe.root, MeshGlobe::fromAbove());
        EXPECT_EQ(after.tested, before.tested);
        EXPECT_LE(after.outside, before.outside);
        EXPECT_TRUE(i == 0 || after.outside == before.outside) << after.outside;
        update(*globe.root);
    }
}

TEST(TileFamily, LeavesOutPartsOfMeshesThatAreSmallFeatures) {
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extentsDeg(0.0, 10.0, 0.0, 10.0), 100.0);
    const osg::ref_ptr<osg::Node> ground = drawableOf(*mesh), sign = drawableOf(*makeTower({}));
    mesh->setChild(0, ground);
    mesh->addChild(makeGroup({sign}));
    const auto globe = makeGlobe({makePaged(mesh, "no.osgb")});
    EXPECT_EQ(installBins(*globe), 1u);
    CullView view = downTo(5.0, 5.0, 2e6, 60.0);
    EXPECT_EQ(cull(*globe, view).drawn.size(), 2u);
    view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    EXPECT_EQ(cull(*globe, view).drawn.size(), 1u);
}

}  // namespace
}  // namespace osgAnalyticBin::test

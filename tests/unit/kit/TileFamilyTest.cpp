// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Families of sibling tiles against the tiles' own callbacks: a callback behind a family's leaves all to these. What is
// delivered of kept tiles: tests/scenes, tests/long/scenes.

#include "KitTest.h"

#include <osgUtil/Optimizer>

namespace osgAnalyticBin::test {
namespace {

// A visitor of an application's own, which hears of every node.
struct OwnVisitor : osgUtil::CullVisitor {
    using osgUtil::CullVisitor::apply;
    void apply(osg::LOD& node) override {
        entered.push_back(&node);
        osgUtil::CullVisitor::apply(node);
    }
    std::vector<const osg::Node*> entered;
};

// Meshes of `degrees`, all over the globe or so far as `count` goes.
osg::ref_ptr<osg::CoordinateSystemNode> globeOfMeshes(double degrees, std::size_t count) {
    osg::ref_ptr<osg::CoordinateSystemNode> globe = makeGlobe();
    for (double south = -90.0; south < 90.0; south += degrees) {
        for (double west = -180.0; west < 180.0 && globe->getNumChildren() < count; west += degrees) {
            const core::GeodeticBin extents = extentsDeg(south, south + degrees, west, west + degrees);
            globe->addChild(makePaged(makeMeshTile(extents, 100.0), "no.osgb"));
        }
    }
    return globe;
}

BinCounts countsOf(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    (void)cull(scene, view, *visitor);
    return BinStatistics::of(*visitor).getCounts();
}

CullView randomView(Random& random) {
    const osg::Vec3d eye =
        ecefDeg(random.uniform(-89.0, 89.0), random.uniform(-180.0, 180.0), random.logUniform(1e3, 3e7));
    const osg::Vec3d target = ecefDeg(random.uniform(-89.0, 89.0), random.uniform(-180.0, 180.0), 0.0);
    CullView view = CullView::lookAt(eye, target, {0.1, 0.2, 1.0}, random.uniform(0.5, 100.0));
    view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    return view;
}

// `methods`: those for comparison are culled by families, too.
void expectSameVerdicts(double degrees, std::size_t tiles, const std::vector<const char*>& methods, int views) {
    for (const char* const method : methods) {
        const CullOptions options = optionsOf(std::string("horizon=off,edges=on,method=") + method);
        const auto families = globeOfMeshes(degrees, tiles), alone = globeOfMeshes(degrees, tiles);
        ASSERT_EQ(installBins(*families, options), families->getNumChildren());
        ASSERT_EQ(installBins(*alone, options), families->getNumChildren());
        alone->addCullCallback(new osg::NodeCallback);
        // families do not test the spheres either
        for (const auto& globe : {families, alone})
            for (unsigned int i = 0; i < globe->getNumChildren(); ++i) globe->getChild(i)->setCullingActive(false);
        Random random(20260101);
        std::uint64_t outside = 0, separated = 0;
        for (int i = 0; i < views; ++i) {
            const CullView view = randomView(random);
            const BinCounts some = countsOf(*families, view), others = countsOf(*alone, view);
            EXPECT_EQ(some.tested, others.tested) << method << i;
            EXPECT_EQ(some.outside, others.outside) << method << i;
            EXPECT_EQ(some.inside, others.inside) << method << i;
            EXPECT_EQ(some.beyondEdge, others.beyondEdge) << method << i;
            outside += some.outside;
            separated += some.beyondEdge;
        }
        EXPECT_GT(outside, 0u) << method;
        EXPECT_TRUE(separated > 0 || tiles < 288) << method;
    }
}

TEST(TileFamily, CullsAsTheTilesThemselves) {
    expectSameVerdicts(15.0, 288, {"quadratic", "exact"}, 200);
    for (const std::size_t tiles : {1u, 3u, 63u, 64u, 65u, 130u}) expectSameVerdicts(15.0, tiles, {"quadratic"}, 40);
}

TEST(TileFamily, RunsTheCallbacksOfItsGroupAndOfItsTiles) {
    MeshGlobe globe;
    std::map<std::string, int> runs;
    const auto counting = [&runs](const std::string& name) {
        return osg::ref_ptr<Before>(new Before([&runs, name](auto&) { ++runs[name]; }));
    };
    const auto before = counting("before"), behind = counting("behind"), onTile = counting("on the tile");
    for (const auto& callback : {before, behind, onTile}) setTraversesAlways(*callback);
    globe.root->setCullCallback(before);
    globe.tiles[19]->setCullCallback(onTile);
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(runs, (std::map<std::string, int>{{"before", 1}, {"on the tile", 1}}));
    globe.root->addCullCallback(behind);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(runs["behind"], 1);
    EXPECT_FALSE(globe.drawsAntipode());
    globe.root->removeCullCallback(behind);
    const auto inFront = counting("in front");
    inFront->setNestedCallback(globe.tiles[19]->getCullCallback());
    globe.tiles[19]->setCullCallback(inFront);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(runs["in front"], 1);
}

TEST(TileFamily, EntersTilesWithTheirStateAndByTheirMasks) {
    MeshGlobe globe;
    osg::PagedLOD& tile = *globe.tiles[19];
    const osg::StateSet* stateAbove = nullptr;
    osg::NodePath path;
    tile.getChild(0)->setCullCallback(new Before([&](osgUtil::CullVisitor& visitor) {
        stateAbove = visitor.getCurrentStateGraph()->getStateSet();
        path = visitor.getNodePath();
    }));
    osg::StateSet* const state = tile.getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(tile, MeshGlobe::fromAbove()));
    EXPECT_EQ(stateAbove, state);
    EXPECT_EQ(std::count(path.begin(), path.end(), &tile), 1);
    tile.setNodeMask(0);
    EXPECT_FALSE(globe.draws(tile, MeshGlobe::fromAbove()));
}

TEST(TileFamily, LetsVisitorsOfAnApplicationMeetTheTilesThatAreKept) {
    InstalledGlobe globe;
    const osg::ref_ptr<OwnVisitor> visitor = new OwnVisitor;
    (void)cull(*globe.root, MeshGlobe::fromAbove(), *visitor);
    const auto met = [&](const osg::PagedLOD& tile) {
        return std::count(visitor->entered.begin(), visitor->entered.end(), &tile);
    };
    EXPECT_EQ(met(*globe.tiles[19]), 1);
    EXPECT_EQ(met(*globe.tiles[15]), 0);
}

// Bins that are stored hold skirts, which lean outwards; the meshes themselves end before.
TEST(TileFamily, FollowsMeshesThatOsgOptimizesWhereAHorizonIsDeclared) {
    MeshGlobe globe;
    constexpr double kLean = 0.0005;
    for (int i = 0; i < 32; ++i) {
        const double south = -90.0 + 45.0 * (i / 8), west = -180.0 + 45.0 * (i % 8);
        setStoredBin(*globe.tiles[static_cast<std::size_t>(i)],
                     AnalyticBin(core::GeodeticBin::fromDegrees(
                         {std::max(south - kLean, -90.0), std::min(south + 45.0 + kLean, 90.0)}, {west, west + 45.0},
                         {-49000.0, 1000.0})));
    }
    installBins(*globe.root, declaredHorizon());
    osgUtil::Optimizer optimizer;
    optimizer.optimize(globe.root.get());
    globe.expectAntipode(false);
    // and one that becomes narrower leaves a gap
    auto& vertices = verticesOf(*globe.tiles[19]);
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

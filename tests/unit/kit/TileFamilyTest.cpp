// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Families of sibling tiles against the tiles' own callbacks: a callback behind a family's leaves all to these.

#include "KitTest.h"

#include <osgUtil/Optimizer>

namespace osgAnalyticBin::test {
namespace {

// Counts how often it is run.
struct RunCounter : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        ++runs;
        traverse(node, nv);
    }
    int runs = 0;
};

// Notes the state and the nodes above it.
struct PlaceReader : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        auto* const visitor = dynamic_cast<osgUtil::CullVisitor*>(nv);
        state = visitor ? visitor->getCurrentStateGraph()->getStateSet() : nullptr;
        path = nv->getNodePath();
        traverse(node, nv);
    }
    const osg::StateSet* state = nullptr;
    osg::NodePath path;
};

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
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
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
        std::string error;
        const auto options = cullOptionsFromText(std::string("horizon=off,edges=on,method=") + method, error);
        ASSERT_TRUE(options) << error;
        const auto families = globeOfMeshes(degrees, tiles);
        const auto alone = globeOfMeshes(degrees, tiles);
        ASSERT_EQ(installBins(*families, *options), families->getNumChildren());
        ASSERT_EQ(installBins(*alone, *options), families->getNumChildren());
        alone->addCullCallback(new osg::NodeCallback);
        // families do not test the spheres either
        for (const auto& globe : {families, alone}) {
            for (unsigned int i = 0; i < globe->getNumChildren(); ++i) globe->getChild(i)->setCullingActive(false);
        }
        Random random(20260101);
        std::uint64_t outside = 0;
        std::uint64_t separated = 0;
        for (int i = 0; i < views; ++i) {
            const CullView view = randomView(random);
            const BinCounts some = countsOf(*families, view);
            const BinCounts others = countsOf(*alone, view);
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
}

TEST(TileFamily, OfAnyNumberOfTilesCullsAsTheTilesThemselves) {
    for (const std::size_t tiles : {1u, 3u, 63u, 64u, 65u, 130u}) expectSameVerdicts(15.0, tiles, {"quadratic"}, 40);
}

TEST(TileFamily, HidesNoLessBehindTheHorizonThanTheTilesThemselves) {
    const auto families = globeOfMeshes(15.0, 288);
    const auto alone = globeOfMeshes(15.0, 288);
    installBins(*families);
    installBins(*alone);
    alone->addCullCallback(new osg::NodeCallback);
    Random random(20260101);
    std::uint32_t hidden = 0;
    for (int i = 0; i < 200; ++i) {
        const CullView view = randomView(random);
        const BinCounts some = countsOf(*families, view);
        EXPECT_GE(some.outside, countsOf(*alone, view).outside) << i;
        hidden += some.hidden;
    }
    EXPECT_GT(hidden, 0u);
}

TEST(TileFamily, RunsTheCallbacksOfItsGroupAndOfItsTiles) {
    MeshGlobe globe;
    const osg::ref_ptr<RunCounter> before = new RunCounter;
    const osg::ref_ptr<RunCounter> behind = new RunCounter;
    const osg::ref_ptr<RunCounter> onTile = new RunCounter;
    for (const auto& callback : {before, behind, onTile}) setTraversesAlways(*callback);
    globe.root->setCullCallback(before);
    globe.tiles[19]->setCullCallback(onTile);
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(before->runs, 1);
    EXPECT_EQ(onTile->runs, 1);
    globe.root->addCullCallback(behind);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(behind->runs, 1);
    EXPECT_FALSE(globe.drawsAntipode());
    globe.root->removeCullCallback(behind);
    const osg::ref_ptr<RunCounter> inFront = new RunCounter;
    inFront->setNestedCallback(globe.tiles[19]->getCullCallback());
    globe.tiles[19]->setCullCallback(inFront);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(inFront->runs, 1);
}

TEST(TileFamily, EntersTilesWithTheirStateAndByTheirMasks) {
    MeshGlobe globe;
    osg::PagedLOD& tile = *globe.tiles[19];
    const osg::ref_ptr<PlaceReader> reader = new PlaceReader;
    tile.getChild(0)->setCullCallback(reader);
    osg::StateSet* const state = tile.getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(tile, MeshGlobe::fromAbove()));
    EXPECT_EQ(reader->state, state);
    EXPECT_EQ(std::count(reader->path.begin(), reader->path.end(), &tile), 1);
    tile.setNodeMask(0);
    EXPECT_FALSE(globe.draws(tile, MeshGlobe::fromAbove()));
}

TEST(TileFamily, LetsVisitorsOfAnApplicationMeetTheTilesThatAreKept) {
    MeshGlobe globe;
    installBins(*globe.root);
    const osg::ref_ptr<OwnVisitor> visitor = new OwnVisitor;
    (void)cull(*globe.root, MeshGlobe::fromAbove(), *visitor);
    const auto met = [&](const osg::PagedLOD& tile) {
        return std::count(visitor->entered.begin(), visitor->entered.end(), &tile);
    };
    EXPECT_EQ(met(*globe.tiles[19]), 1);
    EXPECT_EQ(met(*globe.tiles[15]), 0);
}

TEST(TileFamily, FollowsMeshesThatOsgOptimizes) {
    MeshGlobe globe;
    installBins(*globe.root);
    osgUtil::Optimizer optimizer;
    optimizer.optimize(globe.root.get());
    for (int i = 0; i < 2; ++i) {
        EXPECT_FALSE(globe.drawsAntipode());
        EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
        update(*globe.root);
    }
    // and one that is taken out of it later is missed
    osg::Drawable* const drawable = drawableOf(*globe.tiles[19]);
    drawable->getParent(0)->removeChild(drawable);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(globe.drawsAntipode()) << i;
        update(*globe.root);
    }
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
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(globe.drawsAntipode()) << i;
        update(*globe.root);
    }
    // and one that becomes narrower leaves a gap
    auto& vertices = dynamic_cast<osg::Vec3Array&>(*drawableOf(*globe.tiles[19])->asGeometry()->getVertexArray());
    for (osg::Vec3& vertex : vertices) vertex = vertices.front() + (vertex - vertices.front()) * 0.9F;
    vertices.dirty();
    drawableOf(*globe.tiles[19])->dirtyBound();
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(globe.drawsAntipode()) << i;
        update(*globe.root);
    }
}

// Vertices may change in each frame: the family is not made anew for that.
TEST(TileFamily, StaysWhereMeshesChange) {
    MeshGlobe globe;
    installBins(*globe.root);
    const osg::ref_ptr<osg::Callback> last = globe.root->getCullCallback()->getNestedCallback();
    osg::Geometry& geometry = *drawableOf(*globe.tiles[19])->asGeometry();
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
            osg::Geometry& geometry = *drawableOf(*globe.tiles[static_cast<std::size_t>(i)])->asGeometry();
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
    MeshGlobe globe;
    installBins(*globe.root);
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

}  // namespace
}  // namespace osgAnalyticBin::test

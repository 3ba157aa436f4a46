// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// When the kit looks at what is there in a frame, and when it leaves it to OSG: an application's models beside the
// tiles and in their files (oracle: nodes that count how often they are asked), and tiles where bins gain nothing.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Counts how often a walk through the scene asks whether it is a transform.
class Model : public osg::Group {
public:
    osg::Transform* asTransform() override { return ++asked, nullptr; }
    const osg::Transform* asTransform() const override { return ++asked, nullptr; }
    mutable unsigned int asked = 0;
};

// A model in a group of models, which is not attached to anything yet.
struct Models {
    Models() {
        model->addChild(makeTower(ecefDeg(20, 20, 100.0)));
        group->addChild(model);
    }
    osg::ref_ptr<Model> model = new Model;
    osg::ref_ptr<osg::Group> group = new osg::Group;
};

struct GlobeWithModels : MeshGlobe {
    void install(const CullOptions& options = {}) {
        installBins(*root, options);
        update(*root);
        EXPECT_FALSE(drawsAntipode());
    }
    // Lets a cull traversal notice what has changed, and the next update act on it.
    void settle() {
        for (int i = 0; i < 2; ++i) {
            (void)drawsAntipode();
            update(*root);
        }
    }
    [[nodiscard]] bool isLookedAt(const Model& model) {
        const unsigned int before = model.asked;
        (void)drawsAntipode();
        return model.asked != before;
    }
    Models models;
};

TEST(Models, BesideTilesAreLeftToOsg) {
    GlobeWithModels globe;
    globe.root->addChild(globe.models.group);
    globe.install();
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
    const Models later;
    globe.root->addChild(later.group);
    globe.settle();
    EXPECT_FALSE(globe.isLookedAt(*later.model));
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
    // tiles below a transform are not tested together; nor are those below an osgTerrain::Terrain
    GlobeWithModels moved;
    const auto above = makeTransform({}, {moved.tiles.begin(), moved.tiles.end()});
    above->addChild(moved.models.group);
    moved.root->removeChildren(0, moved.root->getNumChildren());
    moved.root->addChild(above);
    moved.install();
    EXPECT_FALSE(moved.isLookedAt(*moved.models.model));
    // in the file of a tile
    GlobeWithModels filed;
    setFinerWithin(*filed.tiles[19], 1e9f);
    putBelow(*filed.tiles[19], makeGroup({makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0), filed.models.group}));
    filed.install();
    EXPECT_FALSE(filed.isLookedAt(*filed.models.model));
    // where others move
    GlobeWithModels moving;
    const osg::ref_ptr<osg::MatrixTransform> tower = makeTower(ecefDeg(20, 20, 100.0));
    moving.root->addChild(moving.models.group);
    moving.root->addChild(tower);
    moving.install();
    tower->setMatrix(osg::Matrixd::translate(ecefDeg(20, 21, 100.0)));
    EXPECT_FALSE(moving.isLookedAt(*moving.models.model));
}

// Models move up among the children where one before them is taken away.
TEST(Models, AreLeftToOsgWhereOthersComeAndGo) {
    GlobeWithModels globe;
    const Models first;
    globe.root->addChild(first.group);
    globe.root->addChild(globe.models.group);
    globe.install();
    const Models newcomer;
    globe.root->removeChild(first.group);
    globe.root->addChild(newcomer.group);
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
    globe.settle();
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
    EXPECT_FALSE(globe.isLookedAt(*newcomer.model));
}

// What adds to a tile's own mesh does not cover anything.
TEST(Models, InAFileThatAddsToATileAreLeftToOsg) {
    GlobeWithModels globe;
    const TemporaryFolder folder;
    osg::PagedLOD& tile = *globe.tiles[19];
    tile.setDatabasePath(std::string(folder / ""));
    tile.setFileName(1, "models.osgb");
    tile.setRange(0, 0.0f, 1e10f);
    tile.setRange(1, 0.0f, 1e9f);
    ASSERT_TRUE(osgDB::writeNodeFile(*osg::ref_ptr(new osg::Group), folder / "models.osgb"));
    globe.install();
    const osg::ref_ptr<osg::Node> file = readBelow(tile);
    file->asGroup()->addChild(globe.models.group);
    putBelow(tile, file);
    globe.settle();
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
}

// Also below a class of the application's.
TEST(TilesAmongModels, AreLookedForAfterTheNextUpdate) {
    for (const std::string way : {"added", "installed there", "added below"}) {
        GlobeWithModels globe;
        osg::Group& model = *globe.models.model;
        globe.root->addChild(globe.models.group);
        globe.install(declaredHorizon());
        ASSERT_FALSE(globe.isLookedAt(*globe.models.model));
        const auto tile = makeGroup({makeMeshTile(extentsDeg(10, 11, -20, -19), 100.0)});
        const osg::ref_ptr<osg::Group> between = new Model;
        if (way == "installed there") {
            model.addChild(makePaged(tile, "never.osgb"));
            installBins(*globe.root);
        } else {
            EXPECT_EQ(addTile(*globe.root, *tile), 1u);
            between->addChild(tile);
            model.addChild(way == "added" ? tile : between);
        }
        globe.settle();
        EXPECT_TRUE(globe.isLookedAt(*globe.models.model)) << way;
    }
}

// Its frame is moved, and nothing below that changes.
TEST(Models, WithMovingPartsAreDrawnWhereTheyAreMovedTo) {
    MeshGlobe globe;
    setFinerWithin(*globe.tiles[19], 1e9f);
    const osg::Vec3d inTheAir = ecefDeg(20, 60, 1e5);
    const osg::ref_ptr<osg::MatrixTransform> rotor = makeTower({}), hull = makeTower({}), vehicle = makeTower({});
    rotor->setDataVariance(osg::Object::DYNAMIC);
    vehicle->setMatrix(osg::Matrixd::translate(ecefDeg(20, -20, 100.0)));
    vehicle->setChild(0, makeGroup({rotor, hull}));
    putBelow(*globe.tiles[19], makeGroup({makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0), vehicle}).release());
    installBins(*globe.root);
    globe.expectDrawn(*hull, downTo(20, -20));
    vehicle->setMatrix(osg::Matrixd::translate(inTheAir));
    globe.expectDrawn(*hull, beside(inTheAir));
}

// Its frame is another one then.
TEST(Models, AreDrawnWhereAnotherTransformTakesThem) {
    MeshGlobe globe;
    setFinerWithin(*globe.tiles[19], 1e9f);
    const osg::Vec3d inTheAir = ecefDeg(20, 60, 1e5);
    const osg::ref_ptr<osg::MatrixTransform> model = makeTower({}), from = makeTower({}), to = new osg::MatrixTransform;
    from->setMatrix(osg::Matrixd::translate(ecefDeg(20, -20, 100.0)));
    from->setChild(0, model);
    to->setMatrix(osg::Matrixd::translate(inTheAir));
    putBelow(*globe.tiles[19], makeGroup({makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0), from, to}).release());
    installBins(*globe.root);
    globe.expectDrawn(*model, downTo(20, -20));
    from->removeChild(model);
    to->addChild(model);
    globe.expectDrawn(*model, beside(inTheAir));
}

// A node that counts the kit's visits.
class Visited : public osg::Group {
public:
    void accept(osg::NodeVisitor& visitor) override {
        ++visits;
        osg::Group::accept(visitor);
    }
    unsigned int visits = 0;
};

// Both come later to a level below a tile.
TEST(Models, ThatStandStillAreNotReadAgainWhereOneMoves) {
    MeshGlobe globe;
    setFinerWithin(*globe.tiles[19], 1e9f);
    const auto level = makeGroup({makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0)});
    putBelow(*globe.tiles[19], level);
    installBins(*globe.root);
    update(*globe.root);
    const osg::ref_ptr<Visited> still = new Visited, moving = new Visited;
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extentsDeg(20, 20.1, -25, -24.9), 100.0);
    still->addChild(makeMeshTile(extentsDeg(20, 20.1, -25, -24.9), 100.0));
    moving->addChild(mesh);
    for (const auto& model : {still, moving}) level->addChild(model);
    for (int i = 0; i < 2; ++i) {
        (void)globe.root->getBound();
        update(*globe.root);
    }
    (void)globe.root->getBound();
    still->visits = moving->visits = 0;
    mesh->setMatrix(mesh->getMatrix() * osg::Matrixd::translate(0.0, 0.0, 1.0));
    (void)globe.root->getBound();
    EXPECT_EQ(still->visits, 0u);
    EXPECT_GT(moving->visits, 0u);
}

// osg::AutoTransform changes its sphere before OSG tests it.
TEST(Models, OutOfViewAreLeftOutAtOnceUnlessTheyMayChange) {
    GlobeWithModels globe;
    const osg::Vec3d aboveEye = ecefDeg(22.5, -22.5, 2e6);
    const osg::ref_ptr<osg::AutoTransform> turning = new osg::AutoTransform;
    turning->setPosition(aboveEye);
    turning->addChild(makeTower({}));
    const osg::ref_ptr<osg::MatrixTransform> still = makeTower(aboveEye),
                                             seen = makeTower(ecefDeg(22.5, -22.5, 1000.0));
    // who refers to the others while a model is drawn
    std::vector<int> references;
    seen->setCullCallback(new Before([&](auto&) {
        references = {still->referenceCount(), turning->referenceCount()};
    }));
    for (const osg::ref_ptr<osg::Node>& child : {osg::ref_ptr<osg::Node>(seen), {still}, {turning}})
        globe.root->addChild(child);
    globe.install();
    EXPECT_EQ(references, std::vector<int>({2, 3}));
}

// For its visits OSG traverses what is kept: nothing is drawn directly.
class DerivedVisitor : public osgUtil::CullVisitor {};

struct RestingGlobe : MeshGlobe {
    explicit RestingGlobe(const CullOptions& options, osgUtil::CullVisitor* by = new DerivedVisitor) {
        visitor = by;
        install(options);
    }
    void install(const CullOptions& options) {
        installBins(*root, options);
        update(*root);
    }
    // Whether bins are tested in one of so many views.
    bool testsBins(const CullView& view, unsigned int views) {
        unsigned int tested = 0;
        for (unsigned int i = 0; i < views; ++i) {
            last = cull(*scene, view, *visitor, ++frame);
            tested += BinStatistics::of(*visitor).getCounts().tested;
        }
        return tested > 0;
    }
    // After many views.
    bool rests(const CullView& view) {
        (void)testsBins(view, 100);
        // some views in a row, of which one may look whether bins gain something
        return !testsBins(view, 8) || !testsBins(view, 8);
    }
    CullResult last;
};

// Of the whole globe, both sides: spheres and bins are in view.
CullView ofAllTiles() {
    return CullView::lookAt(osg::Vec3d(1e8, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 20.0);
}

TEST(Rest, IsForBinsThatGainNothingUntilTheyGainOrTilesCome) {
    RestingGlobe globe(optionsOf("horizon=off")), other(optionsOf("horizon=off"));
    EXPECT_TRUE(globe.testsBins(ofAllTiles(), 1));
    EXPECT_TRUE(globe.rests(ofAllTiles()));
    EXPECT_EQ(globe.last.drawn.size(), globe.tiles.size());
    // in a corner of a tile, which the spheres of three others reach
    EXPECT_TRUE(globe.testsBins(downTo(4, -4), 33));
    EXPECT_FALSE(globe.rests(downTo(4, -4)));
    ASSERT_TRUE(other.rests(ofAllTiles()));
    ASSERT_TRUE(addTile(*other.root, *makeMeshTile(extentsDeg(10, 11, -20, -19), 100.0)));
    EXPECT_TRUE(other.testsBins(ofAllTiles(), 1));
}

TEST(Rest, IsForEachOfManyDatabases) {
    RestingGlobe globe(optionsOf("horizon=off"));
    const auto all = makeGroup({globe.root});
    for (int i = 0; i < 99; ++i) {
        const MeshGlobe other;
        installBins(*other.root, optionsOf("horizon=off"));
        all->addChild(other.root);
    }
    globe.scene = all;
    update(*all);
    EXPECT_TRUE(globe.rests(ofAllTiles()));
}

// What stands below transforms is searched node by node.
TEST(Rest, IsWhereTheSearchTakesLongerThanItSaves) {
    RestingGlobe globe(declaredHorizon());
    ASSERT_FALSE(globe.rests(ofAllTiles()));
    globe.root->removeChildren(0, globe.root->getNumChildren());
    for (osg::ref_ptr<osg::Node> node : globe.tiles) {
        for (int i = 0; i < 16; ++i) {
            const osg::ref_ptr<osg::Group> above = new osg::MatrixTransform;
            above->addChild(node);
            node = above;
        }
        globe.root->addChild(node);
    }
    globe.install(declaredHorizon());
    EXPECT_TRUE(globe.testsBins(ofAllTiles(), 1));
    EXPECT_TRUE(globe.rests(ofAllTiles()));
}

// OSG's spheres are those of the terrain without it.
TEST(Rest, IsNotForTerrainWithAVerticalScale) {
    RestingGlobe globe(optionsOf("horizon=off"));
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    for (const auto& tile : globe.tiles) terrain->addChild(tile);
    globe.root->removeChildren(0, globe.root->getNumChildren());
    globe.root->addChild(terrain);
    globe.install(optionsOf("horizon=off"));
    EXPECT_TRUE(globe.rests(ofAllTiles()));
    terrain->setVerticalScale(2.0f);
    update(*globe.root);
    EXPECT_FALSE(globe.rests(ofAllTiles()));
}

// And for meshes that are drawn directly, and visitors that watch tiles.
TEST(Rest, IsNotForTilesThatTheHorizonHidesOrOsgWouldLeaveOut) {
    EXPECT_FALSE(RestingGlobe(declaredHorizon()).rests(ofAllTiles()));
    EXPECT_FALSE(RestingGlobe(optionsOf("horizon=off"), new osgUtil::CullVisitor).rests(ofAllTiles()));
    RestingGlobe watched(optionsOf("horizon=off"));
    BinStatistics::of(*watched.visitor).setTileByTile(true);
    EXPECT_FALSE(watched.rests(ofAllTiles()));
    // the application's sphere lies
    struct LyingBound : osg::Node::ComputeBoundingSphereCallback {
        osg::BoundingSphere computeBound(const osg::Node&) const override {
            return {osg::Vec3f(0.0f, 0.0f, 3e8f), 1.0f};
        }
    };
    RestingGlobe globe(optionsOf("horizon=off"));
    osg::PagedLOD& tile = *globe.tiles[19];
    tile.setComputeBoundingSphereCallback(new LyingBound);
    globe.install(optionsOf("horizon=off"));
    EXPECT_FALSE(globe.rests(ofAllTiles()));
    EXPECT_EQ(globe.last.drawn.size(), globe.tiles.size());
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// An application's models beside the tiles and in their files: when the kit looks at them in a frame, and when it
// leaves them to OSG. Oracle: nodes that count how often they are asked.

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
}

// Tiles below a transform are not tested together; nor are those below an osgTerrain::Terrain.
TEST(Models, BesideTilesBelowATransformAreLeftToOsg) {
    GlobeWithModels globe;
    const osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform;
    for (const auto& tile : globe.tiles) above->addChild(tile);
    above->addChild(globe.models.group);
    globe.root->removeChildren(0, globe.root->getNumChildren());
    globe.root->addChild(above);
    globe.install();
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
}

TEST(Models, InTheFileOfATileAreLeftToOsg) {
    GlobeWithModels globe;
    osg::ref_ptr<osg::Group> level = new osg::Group;
    level->addChild(makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0));
    level->addChild(globe.models.group);
    globe.tiles[19]->setRange(0, 1e9f, 1e10f);
    globe.tiles[19]->setRange(1, 0.0f, 1e9f);
    putBelow(*globe.tiles[19], level);
    globe.install();
    EXPECT_FALSE(globe.isLookedAt(*globe.models.model));
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

struct TileComes {
    const char* name;
    std::function<void(GlobeWithModels&, osg::Group&)> come;  // to a model
};

class TilesAmongModels : public testing::TestWithParam<TileComes> {};

TEST_P(TilesAmongModels, AreLookedForAfterTheNextUpdate) {
    GlobeWithModels globe;
    globe.root->addChild(globe.models.group);
    globe.install(declaredHorizon());
    ASSERT_FALSE(globe.isLookedAt(*globe.models.model));
    GetParam().come(globe, *globe.models.model);
    globe.settle();
    EXPECT_TRUE(globe.isLookedAt(*globe.models.model));
}

osg::ref_ptr<osg::Group> smallTile() {
    osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->addChild(makeMeshTile(extentsDeg(10, 11, -20, -19), 100.0));
    return tile;
}

INSTANTIATE_TEST_SUITE_P(Models, TilesAmongModels,
                         testing::Values(TileComes{"Added",
                                                   [](GlobeWithModels& globe, osg::Group& model) {
                                                       const osg::ref_ptr<osg::Group> tile = smallTile();
                                                       EXPECT_EQ(addTile(*globe.root, *tile), 1u);
                                                       model.addChild(tile);
                                                   }},
                                         TileComes{"InstalledThere",
                                                   [](GlobeWithModels& globe, osg::Group& model) {
                                                       const osg::ref_ptr<osg::PagedLOD> tile =
                                                           makePaged(smallTile().get(), "never.osgb");
                                                       model.addChild(tile);
                                                       installBins(*globe.root);
                                                   }},
                                         TileComes{"BelowAClassOfTheApplications",
                                                   [](GlobeWithModels& globe, osg::Group& model) {
                                                       const osg::ref_ptr<osg::Group> tile = smallTile();
                                                       EXPECT_EQ(addTile(*globe.root, *tile), 1u);
                                                       const osg::ref_ptr<osg::Group> between = new Model;
                                                       between->addChild(tile);
                                                       model.addChild(between);
                                                   }}),
                         [](const auto& tested) { return tested.param.name; });

// A node that counts the kit's visits.
class Visited : public osg::Group {
public:
    void accept(osg::NodeVisitor& visitor) override {
        ++visits;
        osg::Group::accept(visitor);
    }
    unsigned int visits = 0;
};

// A level below a tile, with two models that came later.
struct LevelWithModels : MeshGlobe {
    LevelWithModels(int tile, osg::Group* first, osg::Group* second) : still(first), moving(second) {
        osg::PagedLOD& paged = *tiles[static_cast<std::size_t>(tile)];
        const double west = -180.0 + 45.0 * (tile % 8), south = -90.0 + 45.0 * (tile / 8);
        paged.setRange(0, 1e9f, 1e10f);
        paged.setRange(1, 0.0f, 1e9f);
        level->addChild(makeMeshTile(extentsDeg(south, south + 45, west, west + 45), 0.0));
        putBelow(paged, level);
        installBins(*root);
        update(*root);
        for (osg::Group* const model : {still.get(), moving.get()}) {
            model->addChild(makeMeshTile(extentsDeg(south + 20, south + 20.1, west + 20, west + 20.1), 100.0));
            level->addChild(model);
        }
        for (int i = 0; i < 2; ++i) {
            (void)root->getBound();
            update(*root);
        }
        (void)root->getBound();
    }
    osg::ref_ptr<osg::Group> level = new osg::Group;
    const osg::ref_ptr<osg::Group> still, moving;
};

TEST(Models, ThatStandStillAreNotReadAgainWhereOneMoves) {
    const osg::ref_ptr<Visited> still = new Visited, moving = new Visited;
    LevelWithModels globe(19, still, moving);
    still->visits = moving->visits = 0;
    auto& mesh = *globe.moving->getChild(0)->asTransform()->asMatrixTransform();
    mesh.setMatrix(mesh.getMatrix() * osg::Matrixd::translate(0.0, 0.0, 1.0));
    (void)globe.root->getBound();
    EXPECT_EQ(still->visits, 0u);
    EXPECT_GT(moving->visits, 0u);
}

// The new part ignores depth, so nothing may hide it. Its bound is that of the model to which it is added.
TEST(Models, ThatGetANewPartOfTheSameBoundAreReadAgain) {
    LevelWithModels globe(15, new osg::Group, new osg::Group);
    EXPECT_FALSE(globe.draws(*globe.still, MeshGlobe::fromAbove()));
    const osg::ref_ptr<osg::Node> part =
        osg::clone(globe.still->getChild(0), osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_DRAWABLES);
    part->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    globe.still->addChild(part);
    EXPECT_TRUE(globe.draws(*globe.still, MeshGlobe::fromAbove()));
}

// Notes who refers to other models while a model is drawn.
struct ReferenceReader : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        references.clear();
        for (const auto& other : others) references.push_back(other->referenceCount());
        traverse(node, nv);
    }
    std::vector<osg::ref_ptr<osg::Node>> others;
    std::vector<int> references;
};

// osg::AutoTransform changes its sphere before OSG tests it.
TEST(Models, OutOfViewAreLeftOutAtOnceUnlessTheyMayChange) {
    GlobeWithModels globe;
    const osg::ref_ptr<osg::MatrixTransform> seen = makeTower(ecefDeg(22.5, -22.5, 1000.0));
    const osg::ref_ptr<ReferenceReader> reader = new ReferenceReader;
    const osg::Vec3d aboveEye = ecefDeg(22.5, -22.5, 2e6);
    reader->others.emplace_back(makeTower(aboveEye));
    reader->others.emplace_back(new osg::AutoTransform);
    dynamic_cast<osg::AutoTransform&>(*reader->others[1]).setPosition(aboveEye);
    reader->others[1]->asGroup()->addChild(makeTower({}));
    seen->setCullCallback(reader);
    globe.root->addChild(seen);
    for (const auto& other : reader->others) globe.root->addChild(other);
    globe.install();
    EXPECT_EQ(reader->references, std::vector<int>({2, 3}));
}

}  // namespace
}  // namespace osgAnalyticBin::test

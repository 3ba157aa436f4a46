// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles below a tree of plain groups: the search for the lowest surface passes over groups out of view. The records of
// tiles that they go by, which pager threads and cull threads doubt while the update traversal makes families. And the
// eye above the lowest surface that is shown; random databases, eyes and rays: tests/long/scenes.

#include "../../../osgAnalyticBin/src/kit/cull/ShownDepth.h"
#include "../../../osgAnalyticBin/src/kit/cull/TileFamily.h"
#include "../../../osgAnalyticBin/src/kit/tile/InstalledTile.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// 32 tiles of 45 degrees in groups of four, and these in two groups.
struct GroupTree : MeshGlobe {
    GroupTree() {
        root->removeChildren(0, root->getNumChildren());
        for (int half = 0; half < 2; ++half) {
            halves.push_back(new osg::Group);
            root->addChild(halves.back());
        }
        for (unsigned int i = 0; i < 8; ++i) {
            const unsigned int first = i / 4 * 16 + i % 4 * 2;
            groups.push_back(makeGroup({tiles[first], tiles[first + 1], tiles[first + 8], tiles[first + 9]}));
            halves[i / 4]->addChild(groups.back());
        }
        EXPECT_EQ(installBins(*root), 32u);
    }

    // Returns: nullptr where the search does not pass over the group.
    [[nodiscard]] const ColumnUnion* columnsBelow(osg::Group& group) const {
        (void)root->getBound();
        return TileFamily::columnUnionOf(group);
    }

    std::vector<osg::ref_ptr<osg::Group>> halves, groups;
};

TEST(GroupTree, DoubtsWhatIsKeptVisible) {
    GroupTree tree;
    // high in the air, until the next update widens the bin
    tree.tiles[3]->insertChild(0, makeTower(ecefDeg(-70, -30, 50000.0)));
    EXPECT_FALSE(tree.columnsBelow(*tree.halves[0]));
    EXPECT_TRUE(tree.columnsBelow(*tree.halves[1]));
    update(*tree.root);
    EXPECT_TRUE(tree.columnsBelow(*tree.halves[0]));
}

TEST(GroupTree, DoubtsChildrenThatItDoesNotKnow) {
    const auto change = [](int what, osg::Group& group) {
        const osg::ref_ptr<osg::Node> added = what < 2 ? new osg::Group : makeMeshTile(extentsDeg(0, 10, 0, 10), 0.0);
        if (what % 2 == 0) group.addChild(added);
        if (what % 2 == 1) group.setChild(0, added);
    };
    for (int what = 0; what < 4; ++what) {
        for (const bool isDeep : {false, true}) {
            GroupTree tree;
            ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
            change(what, isDeep ? *tree.groups[1] : *tree.halves[0]);
            EXPECT_FALSE(tree.columnsBelow(*tree.halves[0])) << what << isDeep;
            EXPECT_TRUE(tree.columnsBelow(*tree.halves[1]));
        }
    }
}

// A search passes over models. They stand where OSG's spheres say.
TEST(GroupTree, HoldsNoModelsAndDrawsThemWhereverTheyStand) {
    GroupTree tree;
    const osg::Vec3d inTheAir = ecefDeg(22.5, -22.5, 1e6);
    const auto model = makeGroup({makeTower(inTheAir)});
    tree.groups[0]->addChild(model);
    for (const bool isInstalledAgain : {false, true}) {
        if (isInstalledAgain) installBins(*tree.root);
        tree.expectDrawn(*model, beside(inTheAir));
        EXPECT_TRUE(tree.columnsBelow(*tree.groups[0])) << isInstalledAgain;
    }
    const osg::ref_ptr<osg::Node> tile = makeMeshTile(extentsDeg(10, 11, -20, -19), 0.0);
    ASSERT_EQ(addTile(*tree.root, *tile), 1u);
    model->addChild(tile);
    tree.expectDrawn(*model, beside(inTheAir));
    EXPECT_FALSE(tree.columnsBelow(*tree.groups[0]));
}

class InstalledTiles : public ::testing::Test {
protected:
    InstalledTiles() {
        join();
        _other = std::thread([this] {
            while (!_isOver.load()) {
                tile->doubt(InstalledTile::MeshUnread);
                tile->settle(InstalledTile::MeshUnread);
            }
        });
    }
    ~InstalledTiles() override {
        _isOver.store(true);
        _other.join();
    }

    void join() {
        block = new TileBlock(1);
        tile->joinFamily(*block, 0);
        tile->fillSlot({}, {});
    }
    [[nodiscard]] bool isBelieved() const { return block->partFrom(0).believed.load() != 0; }

    const osg::ref_ptr<InstalledDatabase> database = new InstalledDatabase(new osg::EllipsoidModel);
    const osg::ref_ptr<InstalledTile> tile = new InstalledTile(*database, nullptr, {}, 0);
    osg::ref_ptr<TileBlock> block;

private:
    std::atomic<bool> _isOver{false};
    std::thread _other;
};

TEST_F(InstalledTiles, AreNotBelievedWhileTheyAreDoubtedWhateverElseIsSettled) {
    int believed = 0;
    for (int i = 0; i < 20000; ++i) {
        tile->doubt(InstalledTile::Outgrown);
        for (int look = 0; look < 8; ++look) believed += isBelieved() ? 1 : 0;
        tile->settle(InstalledTile::Outgrown);
    }
    EXPECT_EQ(believed, 0);
}

TEST_F(InstalledTiles, AreDoubtedWhileTheirFamiliesAreMadeAnew) {
    for (int i = 0; i < 20000; ++i) join();
}

// Asks for the eye over a database of which nothing is deeper than `deepest`.
struct Asker : osg::NodeCallback {
    explicit Asker(double deepestAltitude) : deepest(deepestAltitude) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        osg::CullStack& cullStack = *nv->asCullStack();
        core::PlaneSet planes;
        for (const osg::Plane& plane : cullStack.getCurrentCullingSet().getFrustum().getPlaneList())
            planes.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
        TileSelection selection;
        const DatabaseView view{*node->asGroup(),
                                *nv,
                                CullTraversal::of(*nv),
                                cullStack,
                                cullStack.getModelViewMatrix(),
                                cullStack.getProjectionMatrix(),
                                planes,
                                nullptr,
                                earth(),
                                {},
                                &selection,
                                &selection};
        const auto found = eyeAboveWhatIsShown(view, *Viewpoint::of(cullStack, *nv, false), deepest, depth);
        if (found && found->isAboveGround) eye = found->horizon;
    }

    const double deepest;
    double depth = 3000.0;
    std::optional<core::HorizonEye> eye;
};

void addLeaf(osg::Group& root, const core::GeodeticBin& extents, double altitude) {
    const auto tile = makeGroup({makeMeshTile(extents, altitude)});
    setStoredBin(*tile, AnalyticBin(extents.withAltitude({altitude - 30.0, altitude + 1.0}), 1.0));
    root.addChild(tile);
}

// Looking east along the equator past the limb, 4500 m below the ellipsoid at its nearest, over tiles of a basin at
// -9000 m that are all below the picture. Beyond the limb there is something at -4000 m.
TEST(ShownDepth, IsThatOfABasinThatLinesOfSightPassHighAboveAndNeverLowerThanDeclared) {
    const auto root = makeGlobe();
    addLeaf(*root, extentsDeg(-1.0, 1.0, -1.0, 0.5), -3000.0);
    for (int i = 10; i < 100; ++i) addLeaf(*root, extentsDeg(-0.025, 0.025, 0.05 * i, 0.05 * (i + 1)), -9000.0);
    EXPECT_EQ(installBins(*root), 91u);
    const double toLimb = std::acos((kEarthRadius - 4500.0) / (kEarthRadius + 2000.0)), beyond = 1.3 * toLimb;
    const core::HorizonBin something(earth(), core::GeodeticBin({0.0, 0.0}, {beyond, beyond}, {-4000.0, -4000.0}));
    const CullView view = CullView::lookAt(ecefDeg(0.0, 0.0, 2000.0),
                                           ecefDeg(0.0, osg::RadiansToDegrees(toLimb), -4500.0), {1, 0, 0}, 0.1);
    for (const double deepest : {std::numeric_limits<double>::infinity(), 3000.0}) {
        const osg::ref_ptr<Asker> asker = new Asker(deepest);
        asker->setNestedCallback(root->getCullCallback());
        root->setCullCallback(asker);
        (void)cull(*root, view);
        root->setCullCallback(asker->getNestedCallback());
        ASSERT_TRUE(asker->eye) << deepest;
        EXPECT_NEAR(asker->depth, 9000.0, deepest > 3000.0 ? 1.0 : 6001.0);
        EXPECT_EQ(asker->eye->hides(something), deepest == 3000.0);
    }
}

struct KnownDatabase : InstalledDatabase {
    KnownDatabase() : InstalledDatabase(new osg::EllipsoidModel) {}
};

// The system may give it the address of one that is gone.
TEST(LastViews, OfADatabaseAreForgottenWithIt) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    CullTraversal& traversal = CullTraversal::of(*visitor);
    osg::ref_ptr<KnownDatabase> database = new KnownDatabase;
    traversal.lastView(*database, *visitor).depth = 1000.0;
    EXPECT_EQ(traversal.lastView(*database, *visitor).depth, 1000.0);
    const KnownDatabase* const before = database;
    database = nullptr;
    std::vector<osg::ref_ptr<KnownDatabase>> others;
    for (int i = 0; i < 1000 && database != before; ++i) others.push_back(database = new KnownDatabase);
    EXPECT_EQ(traversal.lastView(*database, *visitor).depth, 0.0);
}

// What hides terrain may have a thread.
TEST(LastViews, OfADatabaseThatIsGoneAreForgottenWithTheNextThatComes) {
    struct NoHider : TerrainHider {
        Hidden find(const View&, const std::vector<ShownTile>&) override { return {}; }
        bool hidesBall(const glm::dvec3&, double, bool) override { return false; }
    };
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    CullTraversal& traversal = CullTraversal::of(*visitor);
    osg::ref_ptr<KnownDatabase> gone = new KnownDatabase;
    const osg::ref_ptr<KnownDatabase> stays = new KnownDatabase, comes = new KnownDatabase;
    const osg::ref_ptr<TerrainHider> ofGone = new NoHider, ofStays = new NoHider;
    traversal.lastView(*gone, *visitor).hider = ofGone;
    traversal.lastView(*stays, *visitor).hider = ofStays;
    gone = nullptr;
    (void)traversal.lastView(*comes, *visitor);
    EXPECT_EQ(ofGone->referenceCount(), 1);
    EXPECT_EQ(traversal.lastView(*stays, *visitor).hider, ofStays);
}

}  // namespace
}  // namespace osgAnalyticBin::test

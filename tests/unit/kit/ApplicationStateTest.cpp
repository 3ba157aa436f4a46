// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How applications show a globe on which bins are installed: state, masks, callbacks, eyes below the ground.
// Content: ApplicationContentTest.cpp. States of all kinds, more holes: tests/scenes.

#include "KitTest.h"

#include <osg/FrontFace>

namespace osgAnalyticBin::test {
namespace {

// The application or a tile may cull back faces. Then a globe whose front faces look down is open from above.
TEST(SeeThroughTerrain, HidesNothingWhereItsFrontFacesLookDown) {
    MeshGlobe globe;
    const auto mirror = makeTransform(osg::Matrix::scale(1.0, 1.0, -1.0), {globe.root});
    globe.scene = makeGroup({mirror});
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
    // cameras that draw reflections do this
    globe.scene->getOrCreateStateSet()->setAttribute(new osg::FrontFace(osg::FrontFace::CLOCKWISE));
    EXPECT_FALSE(globe.drawsAntipode());
    mirror->setMatrix({});
    EXPECT_TRUE(globe.drawsAntipode());
}

// Programs that compare pictures draw in the order of the traversal.
TEST(SeeThroughTerrain, IsNotWhatAnyBinOfOsgHolds) {
    for (const std::string name : {"RenderBin", "StateSortedBin", "DepthSortedBin", "TraversalOrderBin"}) {
        MeshGlobe globe;
        globe.root->getOrCreateStateSet()->setRenderBinDetails(0, name);
        installBins(*globe.root);
        // OSG draws what it sorts by depth with an alpha test
        EXPECT_EQ(globe.drawsAntipode(), name == "DepthSortedBin") << name;
        globe.root->getStateSet()->setRenderBinDetails(0, "BinOfTheApplication");
        EXPECT_TRUE(globe.drawsAntipode());
        globe.root->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        EXPECT_TRUE(globe.drawsAntipode());
    }
}

// More holes: tests/scenes.
TEST(HoledGlobe, IsSeenThroughWhereATransformMovesAMeshAway) {
    for (const CullOptions& options : {CullOptions(), declaredHorizon()}) {
        MeshGlobe globe;
        const osg::ref_ptr<osg::MatrixTransform> inside = new osg::MatrixTransform;
        inside->addChild(globe.tiles[19]->getChild(0));
        globe.tiles[19]->setChild(0, makeGroup({inside}));
        installBins(*globe.root, options);
        EXPECT_FALSE(globe.drawsAntipode());
        inside->setMatrix(osg::Matrixd::rotate(osg::DegreesToRadians(45.0), osg::Vec3d(0, 0, 1)));
        for (int i = 0; i < 6; ++i) {
            EXPECT_TRUE(globe.drawsAntipode()) << i;
            i < 3 ? update(*globe.root) : static_cast<void>(installBins(*globe.root, options));
        }
    }
}

// A tile below the eye is divided into four, one of these again, and so on: the last one is 600 m wide.
TEST(HoledGlobe, IsSeenThroughWhereOneOfItsSmallestTilesIsMissing) {
    for (const bool hasHole : {false, true}) {
        MeshGlobe globe;
        globe.root->removeChild(globe.tiles[19]);
        const auto add = [&globe](double south, double west, double width) {
            globe.root->addChild(
                makePaged(makeMeshTile(extentsDeg(south, south + width, west, west + width), 0.0), "no.osgb"));
        };
        double south = 0.0, west = -45.0, width = 45.0;
        for (int level = 0; level < 13; ++level) {
            width /= 2.0;
            // nearer and nearer to the middle of the tile, from the south west
            const int inside = level == 0 ? 0 : 3;
            for (int quarter = 0; quarter < 4; ++quarter)
                if (quarter != inside) add(south + width * (quarter / 2), west + width * (quarter % 2), width);
            south += width * (inside / 2);
            west += width * (inside % 2);
        }
        if (!hasHole) add(south, west, width);
        installBins(*globe.root);
        update(*globe.root);
        globe.expectAntipode(hasHole);
    }
}

TEST(HoledGlobe, IsLookedAtSeldomWhereItStaysOne) {
    InstalledGlobe globe;
    globe.tiles[19]->setNodeMask(0);
    for (int i = 0; i < 35; ++i) EXPECT_TRUE(globe.drawsAntipode()) << i;
    globe.tiles[19]->setNodeMask(~0u);
    int late = 0;
    while (late < 100 && globe.drawsAntipode()) ++late;
    EXPECT_EQ(late, 5);
    globe.tiles[19]->setNodeMask(0);
    EXPECT_TRUE(globe.drawsAntipode());
    globe.tiles[19]->setNodeMask(~0u);
    EXPECT_FALSE(globe.drawsAntipode());
}

// A class of the application's that pages tiles need not show what OSG's would.
struct OwnPagedLod : osg::PagedLOD {
    explicit OwnPagedLod(const osg::PagedLOD& other) : osg::PagedLOD(other) {}
    void traverse(osg::NodeVisitor& nv) override {
        if (nv.getVisitorType() != osg::NodeVisitor::CULL_VISITOR) osg::PagedLOD::traverse(nv);
    }
};

TEST(HoledGlobe, IsSeenThroughWhereAClassOfTheApplicationsPagesTiles) {
    for (const bool isBehind : {false, true}) {
        MeshGlobe globe;
        globe.root->replaceChild(globe.tiles[19], new OwnPagedLod(*globe.tiles[19]));
        installBins(*globe.root);
        if (isBehind) globe.root->addCullCallback(new osg::NodeCallback);
        EXPECT_TRUE(globe.drawsAntipode()) << isBehind;
    }
}

// The eye is in the mesh of tile 19; all tiles have finer levels, which are due where `isDue` says so.
struct AwaitedGround : MeshGlobe {
    explicit AwaitedGround(bool isGroundDue) : MeshGlobe(40000.0) {
        for (std::size_t i = 0; i < tiles.size(); ++i) setFinerWithin(*tiles[i], i != 19 || isGroundDue ? 1e9F : 0.0F);
        installBins(*root);
        visitor->setDatabaseRequestHandler(requests);
    }
    // Whether the antipode is asked for. It has to be drawn.
    bool asksForAntipode() {
        requests->nodes.clear();
        EXPECT_TRUE(drawsAntipode(20000.0));
        return requests->nodes.count(tiles[15]) > 0;
    }

    osg::ref_ptr<Requests> requests = new Requests;
};

TEST(AwaitedGround, IsLoadedBeforeWhatTheHorizonWillHide) {
    AwaitedGround globe(true);
    for (int view = 0; view < 120; ++view) ASSERT_FALSE(globe.asksForAntipode()) << view;
    EXPECT_TRUE(globe.requests->nodes.count(globe.tiles[19]));
    EXPECT_TRUE(globe.asksForAntipode()) << "the ground does not come";
    EXPECT_FALSE(globe.drawsAntipode(41000.0));
    EXPECT_FALSE(globe.asksForAntipode()) << "it may come now";
    EXPECT_TRUE(AwaitedGround(false).asksForAntipode()) << "nothing finer is due";
}

TEST(StoredBins, OfDrawablesAreRefused) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::Node> tower = makeTower(ecefDeg(22.5, -22.5, 1000.0));
    osg::Drawable* const drawable = drawableOf(*tower);
    setStoredBin(*drawable, AnalyticBin(extentsDeg(-30, -20, 90, 100)));
    globe.root->addChild(tower);
    const CapturedNotes notes;
    EXPECT_EQ(installBins(*globe.root), 32u);
    EXPECT_EQ(notes.count("drawables are not culled by bins"), 1u);
    EXPECT_EQ(drawable->getCullCallback(), nullptr);
    EXPECT_TRUE(globe.draws(*tower, downTo(22.5, -22.5)));
}

// Notes the planes that are undecided where it stands.
struct MaskReader {
    osg::ref_ptr<Before> callback = new Before([this](osgUtil::CullVisitor& visitor) {
        const osg::Polytope& frustum = visitor.getCurrentCullingSet().getFrustum();
        mask = frustum.getCurrentMask();
        planes = frustum.getPlaneList().size();
    });
    osg::Polytope::ClippingMask mask = 99;
    std::size_t planes = 99;
};

const CullView kFarAbove = CullView::lookAt(ecefDeg(0.5, 0.5, 5e6), ecefDeg(0.5, 0.5, 0), {0, 0, 1}, 30.0);

TEST(DecidedPlanes, AreInheritedByChildrenAndNotBySiblings) {
    const auto root = makeGlobe();
    // a model in view before the tiles: OSG leaves its decided planes behind
    root->addChild(makeTower(ecefDeg(0.5, 0.5, 1000.0)));
    MaskReader first, second, beside;
    for (MaskReader* const reader : {&first, &second}) {
        const auto extents = reader == &first ? extentsDeg(0, 1, 0, 1) : extentsDeg(0, 1, 5, 60);
        const auto child = makeGroup({makeMeshTile(extents, 0.0)}), tile = makeGroup({child});
        // in the first tile, below a sphere; in the second, as the bin leaves it
        (reader == &first ? child : tile)->setCullCallback(reader->callback);
        setStoredBin(*tile, AnalyticBin(extents.withAltitude({-100, 100})));
        root->addChild(tile);
    }
    // and a model beside them that is not tested
    const osg::ref_ptr<osg::Group> model = new osg::Group;
    model->setCullingActive(false);
    model->setCullCallback(beside.callback);
    root->addChild(model);
    ASSERT_EQ(installBins(*root), 2u);
    for (const bool isFamily : {true, false}) {
        // behind a callback behind their family, tiles test themselves
        if (!isFamily) root->addCullCallback(new osg::NodeCallback);
        for (MaskReader* const reader : {&first, &second, &beside}) reader->mask = 99;
        (void)cull(*root, kFarAbove);
        EXPECT_EQ(first.mask, 0u) << "the first tile is inside all planes";
        EXPECT_EQ(second.mask, 2u) << "the second is not inside that to the right, and its sphere crosses three";
        EXPECT_EQ(beside.mask, 15u) << "what tiles decided is theirs";
    }
}

// OSG begins below a transform with all planes that the camera has.
TEST(DecidedPlanes, AreLeftOutBelowTheTransformsOfATileAlone) {
    const auto root = makeGlobe();
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    setStoredBin(*tile, AnalyticBin(extentsDeg(0, 1, 0, 1).withAltitude({-100, 100})));
    root->addChild(tile);
    MaskReader below, beside;
    for (MaskReader* const reader : {&below, &beside}) {
        const auto transform =
            makeTransform(osg::Matrixd::translate(10.0, 0.0, 0.0), {makeTower(ecefDeg(0.5, 0.5, 0.0))});
        transform->setCullCallback(reader->callback);
        (reader == &below ? *tile : *root).addChild(transform);
    }
    ASSERT_EQ(installBins(*root), 1u);
    for (const bool isFamily : {true, false}) {
        if (!isFamily) root->addCullCallback(new osg::NodeCallback);
        below.planes = beside.planes = 99;
        (void)cull(*root, kFarAbove);
        EXPECT_EQ(below.planes, 0u) << "the tile is inside all planes";
        EXPECT_EQ(beside.planes, 4u) << "what stands beside it is not";
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is drawn is selected before: callbacks of an application that change something in between. And OSG's own spheres
// on tiles and on groups above them, which bins leave in use, and which occluders are compared with.

#include "KitTest.h"

#include <osg/ConvexPlanarOccluder>
#include <osg/OccluderNode>
#include <osg/observer_ptr>

namespace osgAnalyticBin::test {
namespace {

// Models of the application's are before and behind the tiles. Tiles 18 and 19 are in view.
struct ModelGlobe : MeshGlobe {
    ModelGlobe() {
        first->addChild(makeTower(ecefDeg(22.5, -22.5, 0.0)));
        last->addChild(makeTower(ecefDeg(22.0, -22.0, 0.0)));
        root->insertChild(0, first);
        root->addChild(last);
    }
    [[nodiscard]] bool shows(osg::Node& node) { return draws(node, fromAbove(3e6)); }

    osg::ref_ptr<osg::Group> first = new osg::Group, last = new osg::Group;
};

TEST(Selection, GoesOnWithoutAStateThatWasTakenAwayMeanwhile) {
    ModelGlobe globe;
    osg::Node& tile = *globe.tiles[19];
    tile.getOrCreateStateSet()->setAttributeAndModes(new osg::Depth);
    installBins(*globe.root);
    globe.first->setCullCallback(new Before([&](auto&) { tile.setStateSet(nullptr); }));
    EXPECT_TRUE(globe.shows(tile));
}

// By a callback of a model, of the mesh of a tile that waits for a file, or of the root; or by who is asked for it.
TEST(Selection, HoldsWhatIsTakenAwayMeanwhile) {
    enum { Model, Mesh, Root, File };
    for (const int where : {Model, Mesh, Root, File}) {
        ModelGlobe globe;
        osg::PagedLOD& tile = *globe.tiles[18];
        setFinerWithin(tile, 1e8f);
        if (where != Model) globe.root->removeChild(globe.first);
        const osg::observer_ptr<osg::Group> last = globe.last.get();
        globe.last = nullptr;
        bool isHeld = false;
        const auto takeAway = [&](auto&&...) {
            if (last.valid()) globe.root->removeChild(last.get());
            isHeld = last.valid();
        };
        const osg::ref_ptr<Before> callback = new Before(takeAway);
        setTraversesAlways(*callback);
        if (where == Root) globe.root->setCullCallback(callback);
        installBins(*globe.root);
        if (where == Model) globe.first->setCullCallback(callback);
        if (where == Mesh) tile.getChild(0)->setCullCallback(callback);
        const osg::ref_ptr<Requests> requests = new Requests;
        if (where == File) requests->action = takeAway;
        globe.visitor->setDatabaseRequestHandler(requests);
        EXPECT_TRUE(globe.shows(*globe.tiles[19]));
        EXPECT_TRUE(isHeld);
        EXPECT_FALSE(last.valid());
    }
}

// Callbacks that promise to traverse are run after it, too.
TEST(Selection, HoldsForTheVisitorThatItWasMadeFor) {
    const auto globeWith = [](const Before::Action& action) {
        MeshGlobe globe;
        const auto file = makeGroup({makeMeshTile(extentsDeg(0.0, 45.0, -45.0, 0.0), 0.0)});
        setFinerWithin(*globe.tiles[19], 1e5f);
        putBelow(*globe.tiles[19], file);
        globe.tiles[18]->setNodeMask(1);
        const osg::ref_ptr<Before> callback = new Before(action);
        setTraversesAlways(*callback);
        globe.root->setCullCallback(callback);
        installBins(*globe.root);
        EXPECT_FALSE(globe.drawsAntipode());
        return globe;
    };
    MeshGlobe plain = globeWith([](auto&) {});
    EXPECT_TRUE(plain.draws(*plain.tiles[18], MeshGlobe::fromAbove(3e6)));
    EXPECT_FALSE(plain.draws(*plain.tiles[19]->getChild(1), MeshGlobe::fromAbove(3e6)));
    MeshGlobe scaled = globeWith([](osgUtil::CullVisitor& visitor) { visitor.setLODScale(0.01f); });
    scaled.visitor->setLODScale(1.0f);
    EXPECT_TRUE(scaled.draws(*scaled.tiles[19]->getChild(1), MeshGlobe::fromAbove(3e6)));
    EXPECT_FALSE(scaled.draws(*scaled.tiles[19], MeshGlobe::fromAbove(3e6)));
    MeshGlobe masked = globeWith([](osgUtil::CullVisitor& visitor) { visitor.setTraversalMask(2); });
    masked.visitor->setTraversalMask(1);
    EXPECT_FALSE(masked.draws(*masked.tiles[18], MeshGlobe::fromAbove(3e6)));
}

// The state above is a group's, and obeys no depth.
TEST(Selection, KnowsTheStatesAboveWhereItIsMadeAnew) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::Group> above = new osg::Group;
    ignoreDepth(*above);
    globe.root->replaceChild(globe.tiles[15], above);
    above->addChild(globe.tiles[15]);
    const osg::ref_ptr<Before> callback =
        new Before([](osgUtil::CullVisitor& visitor) { visitor.setLODScale(2.0f * visitor.getLODScale()); });
    setTraversesAlways(*callback);
    above->setCullCallback(callback);
    installBins(*globe.root);
    EXPECT_FALSE(globe.draws(*globe.tiles[14], MeshGlobe::fromAbove()));
    EXPECT_TRUE(globe.drawsAntipode());
}

// Here the sphere that is set does not even hold the tile's own mesh.
TEST(Spheres, OfPagedLodsThatTheApplicationHasSetHoldWhatIsLoadedBelow) {
    for (const auto mode : {osg::LOD::DISTANCE_FROM_EYE_POINT, osg::LOD::PIXEL_SIZE_ON_SCREEN}) {
        MeshGlobe globe;
        osg::PagedLOD& tile = *globe.tiles[19];
        const osg::BoundingSphere sphere = tile.getChild(0)->getBound();
        tile.setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        tile.setCenter(sphere.center());
        tile.setRadius(0.1f * sphere.radius());
        tile.setRangeMode(mode);
        tile.setRange(0, 0.0f, 1e10f);
        installBins(*globe.root, optionsOf("horizon=off"));
        const bool isByDistance = mode == osg::LOD::DISTANCE_FROM_EYE_POINT;
        EXPECT_EQ(globe.draws(tile, downTo(4, -4)), isByDistance);
        EXPECT_EQ(tile.getBound().radius() >= sphere.radius(), isByDistance);
        EXPECT_EQ(tile.getBound().center(), sphere.center());
        // what the bin of a tile holds needs no larger sphere
        tile.setRadius(2.0f * sphere.radius());
        tile.dirtyBound();
        EXPECT_EQ(tile.getBound().radius(), 2.0f * sphere.radius());
        tile.setRadius(0.1f * sphere.radius());
        tile.dirtyBound();
        (void)tile.getBound();
        removeBins(*globe.root);
        EXPECT_EQ(tile.getBound().radius(), 0.1f * sphere.radius());
    }
}

// Houses in a file of their own, and a finer level of the ground beside them.
TEST(Spheres, OfObjectsStayTheirOnlyTest) {
    MeshGlobe globe;
    const auto makeHouses = [](osg::Group* houses) {
        for (const double place : {1.0, 2.0, 3.0, 4.0}) houses->addChild(makeTower(ecefDeg(place, place, 0.0)));
        return osg::ref_ptr<osg::Group>(houses);
    };
    const auto levels = makeHouses(new osg::LOD), houses = makeHouses(new osg::Group);
    for (unsigned int i = 0; i < 4; ++i) static_cast<osg::LOD&>(*levels).setRange(i, 0.0f, 1e9f);
    const auto ground = makeMeshTile(extentsDeg(0.0, 5.0, 0.0, 5.0), 0.0);
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    for (const auto& child : {levels, houses, osg::ref_ptr<osg::Group>(ground)}) file->addChild(child);
    const osg::ref_ptr<osg::PagedLOD> tile =
        makePaged(makeMeshTile(extentsDeg(0.0, 5.0, 0.0, 5.0), 0.0), "houses", 1e9f);
    putBelow(*tile, file);
    globe.root->addChild(tile);
    installBins(*globe.root);
    EXPECT_NE(installedOn(*tile), nullptr);
    EXPECT_NE(installedOn(*ground), nullptr);
    EXPECT_EQ(levels->getCullCallback(), nullptr);
    for (unsigned int i = 0; i < 4; ++i) EXPECT_EQ(houses->getChild(i)->getCullCallback(), nullptr);
    for (const auto& group : {levels, houses}) {
        EXPECT_TRUE(globe.draws(*group->getChild(1), downTo(2.0, 2.0, 20000.0)));
        EXPECT_FALSE(globe.draws(*group->getChild(2), downTo(2.0, 2.0, 20000.0)));
    }
}

constexpr double kAltitude = 5e6;

// A wall of this size, seen from a place above the globe: half of the picture's height is 0.7.
osg::ref_ptr<osg::Node> makeWall(const CullView& view, double halfSize, double aside) {
    constexpr double kDistance = 0.2 * kAltitude;
    const osg::Matrixd toWorld = osg::Matrixd::inverse(view.modelView);
    const osg::ref_ptr<osg::ConvexPlanarOccluder> occluder = new osg::ConvexPlanarOccluder;
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        const osg::Vec3d corner(aside + x * halfSize, y * halfSize, -1.0);
        occluder->getOccluder().add(osg::Vec3(corner * kDistance * toWorld));
    }
    osg::ref_ptr<osg::OccluderNode> wall = new osg::OccluderNode;
    wall->setOccluder(occluder);
    wall->setCullingActive(false);
    return wall;
}

// The numbers of the globe's tiles that are drawn behind a wall.
std::set<std::size_t> drawnBehind(osg::Node& wall, MeshGlobe& globe, const CullView& view) {
    const auto scene = makeGroup({&wall, globe.root});
    const auto drawn = cull(*scene, view, *globe.visitor, ++globe.frame).drawn;
    std::set<std::size_t> numbers;
    for (std::size_t i = 0; i < globe.tiles.size(); ++i)
        if (drawn.count(drawableOf(*globe.tiles[i]))) numbers.insert(i);
    return numbers;
}

TEST(Occluders, LeaveTilesToOsgsSpheres) {
    MeshGlobe plain, installed;
    installBins(*installed.root);
    Random random(90);
    std::size_t hidden = 0, culled = 0;
    for (int i = 0; i < 60; ++i) {
        const osg::Vec3d eye = ecefDeg(random.uniform(-80.0, 80.0), random.uniform(-180.0, 180.0), kAltitude);
        const osg::Vec3d target = ecefDeg(random.uniform(-80.0, 80.0), random.uniform(-180.0, 180.0), -0.5 * kAltitude);
        CullView view = CullView::lookAt(eye, target, {0, 0, 1}, 70.0);
        // OSG drops occluders whose shadow is a small part of the frustum
        view.projection = osg::Matrixd::perspective(70.0, 1.0, 0.05 * kAltitude, 2e7);
        const osg::ref_ptr<osg::Node> wall = makeWall(view, random.uniform(0.2, 0.6), random.uniform(-0.3, 0.3));
        view.cullingMode |= osg::CullSettings::SHADOW_OCCLUSION_CULLING;
        const std::set<std::size_t> drawn = drawnBehind(*wall, installed, view);
        EXPECT_EQ(drawn, drawnBehind(*wall, plain, view)) << i;
        view.cullingMode &= ~osg::CullSettings::SHADOW_OCCLUSION_CULLING;
        const std::size_t inView = drawnBehind(*wall, plain, view).size();
        hidden += inView - drawn.size();
        culled += inView - drawnBehind(*wall, installed, view).size();
    }
    EXPECT_GT(hidden, 30u);
    EXPECT_GT(culled, 60u) << "bins, in views without occluders";
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What applications put on a globe on which bins are installed: content of their own, clones.
// Oracle: what OSG draws of the same scene; random scenes of all of this: tests/long/scenes. State, masks and eyes:
// ApplicationStateTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

TEST(AddedContent, IsATileThatIsATransformAndMoves) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform;
    tile->addChild(makeMeshTile(extentsDeg(10, 20, 10, 20), 1000.0));
    setStoredBin(*tile, AnalyticBin(core::GeodeticBin::fromDegrees({10, 20}, {10, 20}, {-60000, 2000})));
    globe.root->addChild(tile);
    installBins(*globe.root);
    ASSERT_NE(installedOn(*tile), nullptr);
    EXPECT_TRUE(globe.draws(*tile, downTo(15, 15)));
    EXPECT_FALSE(globe.draws(*tile, downTo(15, 135)));
    tile->setMatrix(osg::Matrixd::rotate(osg::DegreesToRadians(120.0), osg::Vec3d(0, 0, 1)));
    globe.expectDrawn(*tile, downTo(15, 135));
}

// 20 km above the middle of a tile, in the frame of its mesh.
struct AboveTheMesh {
    explicit AboveTheMesh(MeshGlobe& globe)
        : mesh(*globe.tiles[19]->getChild(0)->asGroup()),
          place(ecefDeg(22.5, -22.5, 20000.0)),
          local(place * osg::Matrixd::inverse(mesh.getWorldMatrices()[0])) {}

    osg::Group& mesh;
    osg::Vec3d place, local;
};

// Draws beside its children, if it may have any: as osgSim::LightPointNode and osgVolume::VolumeTile do.
template <class Base>
struct Drawing : Base {
    explicit Drawing(const osg::Vec3d& at) : place(at) {}
    osg::BoundingSphere computeBound() const override {
        osg::BoundingSphere bound = Base::computeBound();
        bound.expandBy(osg::BoundingSphere(place, 50.0f));
        return bound;
    }
    void traverse(osg::NodeVisitor& nv) override {
        isDrawn = isDrawn || nv.asCullVisitor();
        Base::traverse(nv);
    }
    const osg::Vec3 place;
    bool isDrawn = false;
};
using Balloon = Drawing<osg::Group>;

// It stands above the middle of tile 19.
template <class Content>
void expectDrawnWhereItIs(MeshGlobe& globe, const Content& content, double altitude) {
    installBins(*globe.root);
    (void)globe.draws(*globe.root, beside(ecefDeg(-22.5, 150.0, altitude)));
    EXPECT_FALSE(content.isDrawn);
    (void)globe.draws(*globe.root, beside(ecefDeg(22.5, -22.5, altitude)));
    EXPECT_TRUE(content.isDrawn);
}

TEST(ContentOfMeshes, IsDrawnByANodeOrAGroupOfAnyClass) {
    const auto expectDrawn = [](auto&& make) {
        MeshGlobe globe;
        const AboveTheMesh above(globe);
        const auto content = make(above.local);
        above.mesh.addChild(content);
        expectDrawnWhereItIs(globe, *content, 20000.0);
        EXPECT_NE(installedOn(*globe.tiles[19]), nullptr);
    };
    expectDrawn([](const osg::Vec3d& at) { return osg::ref_ptr<Drawing<osg::Node>>(new Drawing<osg::Node>(at)); });
    for (const bool hasChild : {false, true}) {
        expectDrawn([hasChild](const osg::Vec3d& at) {
            const osg::ref_ptr<Balloon> balloon = new Balloon(at);
            if (hasChild) balloon->addChild(makeTower({}));
            return balloon;
        });
    }
}

TEST(ContentOfFiles, IsDrawnByAGroupOfAnyClass) {
    MeshGlobe globe;
    // beside the sphere of what is below
    const osg::ref_ptr<Balloon> balloon = new Balloon(ecefDeg(22.5, -22.5, 8e6));
    balloon->addChild(makePaged(makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0), "none.osgb"));
    globe.tiles[19]->setRange(1, 0.0f, 1e10f);
    putBelow(*globe.tiles[19], balloon);
    expectDrawnWhereItIs(globe, *balloon, 8e6);
}

// Nothing asks for the bounds of what it does not show.
TEST(ContentOfMeshes, IsNoticedBelowALevelThatIsNotShown) {
    MeshGlobe globe;
    const AboveTheMesh above(globe);
    const osg::ref_ptr<osg::LOD> level = new osg::LOD;
    level->setCenter(above.local);
    level->setRadius(3e6f);
    const osg::ref_ptr<osg::Geometry> tower = drawableOf(*makeTower({}))->asGeometry();
    level->addChild(makeGroup({tower}), 0.0f, 20000.0f);
    above.mesh.addChild(level);
    installBins(*globe.root);
    EXPECT_FALSE(globe.draws(*tower, MeshGlobe::fromAbove()));
    auto& vertices = static_cast<osg::Vec3Array&>(*tower->getVertexArray());
    for (osg::Vec3& vertex : vertices) vertex += osg::Vec3(above.local);
    vertices.dirty();
    tower->dirtyBound();
    globe.expectDrawn(*tower, beside(above.place), true, 2);
}

// Lies for all visitors but those that draw, for which it stands upright.
struct Upright : osg::MatrixTransform {
    bool computeLocalToWorldMatrix(osg::Matrix& matrix, osg::NodeVisitor* nv) const override {
        const bool isUpright = nv && nv->asCullVisitor();
        matrix.preMultRotate(osg::Quat(isUpright ? osg::PI_4 : -osg::PI_4, osg::X_AXIS));
        return true;
    }
};

TEST(ContentOfMeshes, IsDrawnAsItTurnsToTheEye) {
    MeshGlobe globe;
    const AboveTheMesh above(globe);
    const osg::ref_ptr<osg::MatrixTransform> sign = new Upright;
    sign->addChild(makeTower(osg::Vec3d(0.0, -30000.0, -30000.0), 60000.0f));
    osg::Matrixd frame;
    globe.root->getEllipsoidModel()->computeLocalToWorldTransformFromLatLongHeight(
        osg::DegreesToRadians(22.5), osg::DegreesToRadians(-22.5), 0.0, frame);
    const osg::ref_ptr<osg::MatrixTransform> stand =
        new osg::MatrixTransform(frame * osg::Matrixd::inverse(above.mesh.getWorldMatrices()[0]));
    stand->addChild(sign);
    above.mesh.addChild(stand);
    const CullView view = beside(ecefDeg(22.5, -22.5, 25000.0));
    ASSERT_TRUE(globe.draws(*sign, view));
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(*sign, view));
}

TEST(ContentOfMeshes, IsDrawnWhereABillboardHasMovedIt) {
    MeshGlobe globe;
    const AboveTheMesh above(globe);
    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    billboard->addDrawable(drawableOf(*makeTower({})), osg::Vec3(0.0f, 0.0f, 0.0f));
    above.mesh.addChild(billboard);
    installBins(*globe.root);
    EXPECT_FALSE(globe.draws(*billboard, beside(above.place)));
    billboard->setPosition(0, above.local);
    billboard->dirtyBound();
    globe.expectDrawn(*billboard, beside(above.place), true, 2);
}

// A file of one transform with ground, a house, a tower in the air, and a mill that an application moves.
TEST(AddedContent, BesideOneThatMovesKeepsOsgsOwnCullingAndIsHeldByTheBinsAbove) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::MatrixTransform> content = makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0);
    const osg::Matrixd toLocal = osg::Matrixd::inverse(content->getMatrix());
    std::vector<osg::ref_ptr<osg::MatrixTransform>> things;
    const osg::Vec3d inTheAir = ecefDeg(15, 10, 30000.0);
    for (const osg::Vec3d& place : {ecefDeg(20, 20, 200.0), inTheAir, ecefDeg(25, 30, 200.0)}) {
        things.push_back(makeTower(place));
        things.back()->setMatrix(things.back()->getMatrix() * toLocal);
        content->addChild(things.back());
    }
    osg::MatrixTransform& mill = *things[2];
    mill.setDataVariance(osg::Object::DYNAMIC);
    pageOut(*globe.tile);
    putBelow(*globe.tile, makeGroup({content}));
    installBins(*globe.root);
    update(*globe.root);
    EXPECT_NE(installedOn(*content->getChild(0)), nullptr) << "the ground";
    for (const auto& thing : things) {
        EXPECT_EQ(installedOn(*thing), nullptr);
        EXPECT_TRUE(thing->getCullingActive());
    }
    EXPECT_TRUE(globe.draws(*things[0], downTo(20, 20, 3000.0, 5.0)));
    EXPECT_TRUE(globe.draws(*things[1], beside(inTheAir)));
    EXPECT_FALSE(globe.draws(*things[0], downTo(12, 5, 3000.0, 5.0)));
    EXPECT_TRUE(globe.draws(mill, downTo(25, 30, 3000.0, 5.0)));
    mill.setMatrix(osg::Matrixd::translate(ecefDeg(25, 33, 40000.0)) * toLocal);
    globe.expectDrawn(mill, beside(ecefDeg(25, 33, 40000.0)), true, 2);
}

TEST(AddedContent, ThatMakesATileNoneLeavesItToOsg) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::MatrixTransform> vehicle = makeTower(ecefDeg(20, 20, 100.0));
    vehicle->setDataVariance(osg::Object::DYNAMIC);
    globe.tile->addChild(vehicle, 0.0f, 1e10f);
    setCullOptions(*globe.root, {});
    EXPECT_EQ(installedOn(*globe.tile), nullptr);
    EXPECT_TRUE(globe.tile->getCullingActive());
    vehicle->setMatrix(osg::Matrixd::translate(ecefDeg(20, 100.0, 100.0)));
    EXPECT_TRUE(globe.draws(*vehicle, downTo(20, 100.0, 3000.0, 5.0)));
}

TEST(AddedContent, IsNoticedBelowLevelsOfDetailThatTellTheirOwnBound) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::LOD> level = new osg::LOD;
    level->setCenter(osg::Vec3(0, 0, 0));
    level->setRadius(7e6f);
    globe.root->replaceChild(globe.tiles[19], level);
    level->addChild(globe.tiles[19], 0.0f, 1e10f);
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode()) << "a level of detail may leave a hole";
    const osg::Vec3d place = ecefDeg(20, -20, 30000.0);
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    globe.tiles[19]->addChild(tower, 0.0f, 1e10f);
    EXPECT_TRUE(globe.draws(*tower, beside(place)));
}

// What OSG does not cull below a tile keeps the tile and those above it, too: a light shines on everything beside it.
class NeverCulled : public testing::TestWithParam<bool> {
protected:
    // Adds it beside the ground of the leaf, or beside the leaf.
    static void add(FiledGlobe& globe, osg::Node& content) {
        osg::Group* const leaf = globe.group->getChild(0)->asGroup();
        (GetParam() ? leaf->getChild(0)->asGroup() : globe.group.get())->addChild(&content);
    }
    // From the next view on.
    static void expectOnceAdded(FiledGlobe& globe, osg::Node& content, const std::function<bool()>& shows) {
        EXPECT_FALSE(shows());
        add(globe, content);
        for (int i = 0; i < 2; ++i) {
            EXPECT_TRUE(shows()) << i;
            update(*globe.root);
        }
        installBins(*globe.root);
        EXPECT_TRUE(shows());
    }
};

TEST_P(NeverCulled, IsALightSource) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    expectOnceAdded(globe, *source, [&] { return globe.shines(*source->getLight(), downTo(20, 100.0)); });
}

// It draws a picture of its own, into a texture for instance, whether the tile is in view or not.
TEST_P(NeverCulled, IsACamera) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->addChild(makeTower(ecefDeg(20, 20, 200.0)));
    expectOnceAdded(globe, *camera, [&] {
        (void)globe.draws(*globe.tile, beside(ecefDeg(20, 20, 30000.0)));
        return !globe.visitor->getRenderStage()->getPreRenderList().empty();
    });
}

INSTANTIATE_TEST_SUITE_P(BesideALeafAndWithin, NeverCulled, testing::Bool());

// An application's callback in front of the bin's: the clones of its node share both.
TEST(Clones, ThatShareAnApplicationsCallbackAreRestoredTogether) {
    InstalledGlobe globe;
    osg::Node& tile = *globe.tiles[19];
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Callback> application = new VisitRecorder("tile", visited);
    application->setNestedCallback(tile.getCullCallback());
    tile.setCullCallback(application);
    const unsigned int slot = tile.getParent(0)->getChildIndex(&tile);
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (int i = 0; i < 2; ++i) scene->addChild(osg::clone(globe.root.get(), osg::CopyOp::DEEP_COPY_NODES));
    const auto cloneOfTile = [&](unsigned int i) { return scene->getChild(i)->asGroup()->getChild(slot); };
    ASSERT_EQ(cloneOfTile(1)->getCullCallback(), application.get());
    removeBins(*scene);
    for (unsigned int i = 0; i < 2; ++i) {
        EXPECT_EQ(cloneOfTile(i)->getCullCallback(), application.get()) << i;
        EXPECT_EQ(dynamic_cast<osg::PagedLOD&>(*cloneOfTile(i)).getMinimumExpiryTime(1), 0.0) << i;
    }
    EXPECT_EQ(application->getNestedCallback(), nullptr);
}

// A mast that lies in the tile, and stands up: its sphere stays the same.
TEST(AddedContent, ThatTurnsInItsSphereIsDrawn) {
    InstalledGlobe globe;
    constexpr float kHalf = 30000.0f;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-kHalf, 0, 0), osg::Vec3(kHalf, 100, 0), osg::Vec3(kHalf, -100, 0)})
        vertices->push_back(v);
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    // up is x there, nearly
    const osg::Matrixd standing = osg::Matrixd::translate(ecefDeg(1, -1, 5000.0));
    const osg::Matrixd lying = osg::Matrixd(0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * standing;
    const osg::ref_ptr<osg::MatrixTransform> mast = placed(geometry, lying);
    globe.tiles[19]->addChild(mast, 0.0f, 1e10f);
    const CullView above = beside(ecefDeg(1, -1, 25000.0));
    globe.expectDrawn(*mast, above, false, 2);
    const osg::BoundingSphere sphere = mast->getBound();
    mast->setMatrix(standing);
    ASSERT_EQ(mast->getBound(), sphere);
    globe.expectDrawn(*mast, above, true, 2);
}

}  // namespace
}  // namespace osgAnalyticBin::test

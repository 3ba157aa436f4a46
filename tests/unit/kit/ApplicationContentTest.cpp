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

// Draws beside its children, as osgVolume::VolumeTile does. What nodes of any class draw in meshes:
// MeshTileSurfaceTest.cpp.
struct Balloon : osg::Group {
    explicit Balloon(const osg::Vec3d& at) : place(at) {}
    osg::BoundingSphere computeBound() const override {
        osg::BoundingSphere bound = osg::Group::computeBound();
        bound.expandBy(osg::BoundingSphere(place, 50.0f));
        return bound;
    }
    void traverse(osg::NodeVisitor& nv) override {
        isDrawn = isDrawn || nv.asCullVisitor();
        osg::Group::traverse(nv);
    }
    const osg::Vec3 place;
    bool isDrawn = false;
};

TEST(ContentOfFiles, IsDrawnByAGroupOfAnyClass) {
    MeshGlobe globe;
    // beside the sphere of what is below
    const osg::ref_ptr<Balloon> balloon = new Balloon(ecefDeg(22.5, -22.5, 8e6));
    balloon->addChild(makePaged(makeMeshTile(extentsDeg(0, 45, -45, 0), 0.0), "none.osgb"));
    globe.tiles[19]->setRange(1, 0.0f, 1e10f);
    putBelow(*globe.tiles[19], balloon);
    installBins(*globe.root);
    (void)globe.draws(*globe.root, beside(ecefDeg(-22.5, 150.0, 8e6)));
    EXPECT_FALSE(balloon->isDrawn);
    (void)globe.draws(*globe.root, beside(ecefDeg(22.5, -22.5, 8e6)));
    EXPECT_TRUE(balloon->isDrawn);
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
    (void)above.mesh.getBound();  // as a visitor of the application's may ask for it
    globe.expectDrawn(*billboard, beside(above.place), true, 2);
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

// The application's reader adds it to a file, and the pager computes the bound of what it has read.
TEST(AddedContent, IsNoticedWhereAFileBringsIt) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::Group> file = readBelow(*globe.tile)->asGroup();
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    file->addChild(tower);
    (void)file->getBound();
    globe.tile->replaceChild(globe.group, file);
    EXPECT_TRUE(globe.draws(*tower, beside(place)));
}

TEST(AddedContent, ThatIsShownInPlaceOfTheMeshLeavesAHole) {
    MeshGlobe globe;
    osg::PagedLOD& tile = *globe.tiles[19];
    tile.setFileName(1, "");
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    tile.addChild(makeTower(ecefDeg(22.5, -22.5, 100.0)), 0.0f, 1e10f);
    tile.setRange(0, 1e10f, 2e10f);
    globe.expectAntipode(true);
}

TEST(AddedContent, IsDrawnWhereTheApplicationHasTakenOffTheWatchOfATileWithoutSiblings) {
    FiledGlobe globe;
    const osg::ref_ptr<osg::PagedLOD> leaf = makePaged(globe.group->getChild(0), "no.osgb");
    globe.tile->setChild(1, leaf);
    installBins(*globe.root);
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    ASSERT_FALSE(globe.draws(*leaf, beside(place)));
    leaf->setComputeBoundingSphereCallback(nullptr);
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    leaf->addChild(tower, 0.0f, 1e10f);
    globe.expectDrawn(*tower, beside(place));
}

// It keeps the tile and those above it, from the next view on.
void expectNeverCulled(osg::Node& content, const std::function<bool(FiledGlobe&)>& shows) {
    for (const bool isWithin : {false, true}) {
        FiledGlobe globe;
        EXPECT_FALSE(shows(globe));
        (isWithin ? globe.group->getChild(0)->asGroup()->getChild(0)->asGroup() : globe.group.get())
            ->addChild(&content);
        for (int i = 0; i < 2; ++i) {
            EXPECT_TRUE(shows(globe)) << i << isWithin;
            update(*globe.root);
        }
        installBins(*globe.root);
        EXPECT_TRUE(shows(globe)) << isWithin;
    }
}

// It shines on everything beside it.
TEST(NeverCulled, IsALightSource) {
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    expectNeverCulled(*source, [&](FiledGlobe& globe) { return globe.shines(*source->getLight(), downTo(20, 100.0)); });
}

// It draws a picture of its own, into a texture for instance, whether the tile is in view or not.
TEST(NeverCulled, IsACamera) {
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->addChild(makeTower(ecefDeg(20, 20, 200.0)));
    expectNeverCulled(*camera, [](FiledGlobe& globe) {
        (void)globe.draws(*globe.tile, beside(ecefDeg(20, 20, 30000.0)));
        return !globe.visitor->getRenderStage()->getPreRenderList().empty();
    });
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

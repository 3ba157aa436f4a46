// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles behind a ridge, where OSG computes the near plane. Something far away beside them: tests/scenes/computed-near*.

#include "KitTest.h"
#include "RidgeGlobe.h"

namespace osgAnalyticBin::test {
namespace {

// A camera whose near and far planes OSG computes, with a scene of a globe and something beside it.
struct ComputedPlanes {
    explicit ComputedPlanes(const CullOptions& options = withOcclusion()) {
        scene->addChild(globe.root);
        globe.scene = scene;
        view.camera = new osg::Camera;
        view.camera->addChild(scene);
        view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
        globe.visitor->setNearFarRatio(1e-5);
        installBins(*globe.root, options);
    }

    [[nodiscard]] bool hidesFarTile() { return !globe.drawsFarTile(view); }

    // A point in the frame of the scene.
    static osg::ref_ptr<osg::Geometry> drawableAt(const osg::Vec3& point) {
        osg::ref_ptr<osg::Geometry> drawable = new osg::Geometry;
        drawable->setVertexArray(new osg::Vec3Array(1, &point));
        drawable->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 1));
        return drawable;
    }
    // At a distance ahead of the eye, in metres.
    [[nodiscard]] osg::ref_ptr<osg::Geometry> drawableAhead(double distance) const {
        return drawableAt(osg::Vec3d(0.0, 0.0, -distance) * osg::Matrixd::inverse(view.modelView));
    }

    RidgeGlobe globe;
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    CullView view = RidgeGlobe::alongRow();
};

TEST(ComputedNear, LeavesWhatIsHiddenWhereThePlaneIsNear) {
    ComputedPlanes planes;
    EXPECT_TRUE(planes.hidesFarTile());
    planes.scene->addChild(planes.drawableAhead(1e6));
    EXPECT_TRUE(planes.hidesFarTile());
    // planes of their own
    const osg::ref_ptr<osg::Camera> overlay = new osg::Camera;
    overlay->addChild(planes.drawableAhead(1e10));
    planes.scene->addChild(overlay);
    EXPECT_TRUE(planes.hidesFarTile());
}

// OSG moves an oblique plane along the look direction.
TEST(ComputedNear, IsNotKnownOfAnObliquePlane) {
    ComputedPlanes planes;
    EXPECT_TRUE(planes.hidesFarTile());
    planes.view.projection(0, 2) = 0.1;
    EXPECT_FALSE(planes.hidesFarTile());
}

// A camera's own callback may draw anything, unless it is declared.
TEST(ComputedNear, IsNotKnownBelowACameraWithACallback) {
    struct OwnCull : public osg::NodeCallback {
        void operator()(osg::Node* node, osg::NodeVisitor* nv) override { traverse(node, nv); }
    };
    ComputedPlanes planes;
    const osg::ref_ptr<OwnCull> callback = new OwnCull;
    planes.view.camera->setCullCallback(callback);
    EXPECT_FALSE(planes.hidesFarTile());
    setTraversesAlways(*callback);
    EXPECT_TRUE(planes.hidesFarTile());
    setTraversesAlways(*callback, false);
    EXPECT_FALSE(planes.hidesFarTile());
}

// Where the root tests no tiles together, OSG enters what is there by itself.
TEST(ComputedNear, IsAsFarAsWhatIsBesideTheTilesOfTheDatabase) {
    for (const bool isTerrain : {true, false}) {
        ComputedPlanes planes;
        const osg::ref_ptr<osg::Group> tiles = new osg::Group(*planes.globe.root);
        tiles->setCullCallback(nullptr);
        tiles->setUpdateCallback(nullptr);
        tiles->setComputeBoundingSphereCallback(nullptr);
        osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        if (isTerrain) root = new osgTerrain::Terrain;
        root->setEllipsoidModel(new osg::EllipsoidModel);
        root->addChild(tiles);
        planes.scene->replaceChild(planes.globe.root, root);
        planes.globe.root = root;
        installBins(*root, withOcclusion());
        if (!isTerrain) root->addCullCallback(new osg::NodeCallback);
        EXPECT_TRUE(planes.hidesFarTile()) << isTerrain;
        root->addChild(planes.drawableAhead(1e10));
        EXPECT_FALSE(planes.hidesFarTile()) << isTerrain;
    }
}

TEST(ComputedNear, IsUnknownBesideWhatIsUnknown) {
    struct Unknown : osg::Group {};
    struct Callback : osg::NodeCallback {
        void operator()(osg::Node* node, osg::NodeVisitor* visitor) override { traverse(node, visitor); }
    };
    for (const bool isClass : {true, false}) {
        ComputedPlanes planes;
        const osg::ref_ptr<osg::Group> beside = isClass ? new Unknown : new osg::Group;
        beside->setName("the stranger");
        if (!isClass) beside->setCullCallback(new Callback);
        planes.scene->addChild(beside);
        const CapturedNotes notes(osg::INFO);
        for (int i = 0; i < 3; ++i) EXPECT_FALSE(planes.hidesFarTile());
        EXPECT_EQ(notes.count("the stranger"), 1u);
    }
    // as it may be moved by the application
    struct Clamp : osg::CullSettings::ClampProjectionMatrixCallback {
        bool clampProjectionMatrixImplementation(osg::Matrixf&, double&, double&) const override { return false; }
        bool clampProjectionMatrixImplementation(osg::Matrixd&, double&, double&) const override { return false; }
    };
    ComputedPlanes clamped;
    clamped.globe.visitor->setClampProjectionMatrixCallback(new Clamp);
    EXPECT_FALSE(clamped.hidesFarTile());
    ComputedPlanes byPrimitives;
    byPrimitives.view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES;
    EXPECT_FALSE(byPrimitives.hidesFarTile());
    struct Derived : osgUtil::CullVisitor {};
    ComputedPlanes derived;
    derived.globe.visitor = new Derived;
    derived.globe.visitor->setNearFarRatio(1e-5);
    EXPECT_FALSE(derived.hidesFarTile());
    setDrawsAsCullVisitor(*derived.globe.visitor);
    EXPECT_TRUE(derived.hidesFarTile());
}

// The plane is where OSG puts it when all is drawn that is not hidden, not where it would be with less.
TEST(ComputedNear, CutsAwayWhatItReaches) {
    ComputedPlanes planes;
    EXPECT_TRUE(planes.hidesFarTile());
    planes.globe.visitor->setNearFarRatio(0.05);  // the ridge is in front of it
    EXPECT_FALSE(planes.hidesFarTile());
    planes.globe.visitor->setNearFarRatio(1e-5);
    EXPECT_TRUE(planes.hidesFarTile());
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What hides is known to be drawn, what is hidden is known to obey depth, and where OSG computes the near plane, it is
// known not to cut anything open: meshes, states, callbacks, whatever an application makes of them. More of it, and all
// states one by one: tests/scenes.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Gives a tile the vertices of another mesh, as OSG asks for it.
void takeVertices(osg::MatrixTransform& from, osg::PagedLOD& tile) {
    const auto& mesh = dynamic_cast<const osg::MatrixTransform&>(*tile.getChild(0));
    const osg::Vec3d shift = from.getMatrix().getTrans() - mesh.getMatrix().getTrans();
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& vertex : verticesOf(from)) vertices->push_back(osg::Vec3d(vertex) + shift);
    geometryOf(tile).setVertexArray(vertices);
    geometryOf(tile).dirtyBound();
}

// Shows a file with the own mesh of a tile.
void addTo(osg::PagedLOD& tile, osg::Node* file) {
    tile.setRange(0, 0.0f, 1e10f);
    tile.setRange(1, 0.0f, 1e10f);
    putBelow(tile, file);
}

TEST(AddedLevels, HideWhatIsBehindThemUnlessTheyAreSeenThrough) {
    for (const bool isBlended : {false, true}) {
        RidgeGlobe globe(0.0);
        const auto file = makeGroup({makePaged(makeMeshTile(extentsDeg(0, 0.2, 0.4, 0.6), 8000.0), "no.osgb")});
        if (isBlended) file->getChild(0)->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        addTo(*globe.row[2], file);
        installBins(*globe.root, optionsOf("occlusion=on"));
        EXPECT_EQ(globe.drawsFarTile(), isBlended);
        EXPECT_TRUE(globe.draws(*file, RidgeGlobe::alongRow())) << isBlended;
    }
}

// A texture of the application's own may draw nothing.
TEST(Evidence, IsMissingInAStateOfTheApplicationsClass) {
    struct OwnTexture : osg::Texture2D {};
    InstalledGlobe globe;
    EXPECT_FALSE(globe.drawsAntipode());
    globe.root->getOrCreateStateSet()->setTextureAttributeAndModes(0, new OwnTexture);
    EXPECT_TRUE(globe.drawsAntipode());
}

// On the tile, on its mesh, and deeper in it.
TEST(Evidence, IsMissingWhereOsgCullsClusters) {
    for (int depth = 0; depth < 3; ++depth) {
        RidgeGlobe globe;
        osg::Node* node = globe.row[2];
        for (int i = 0; i < depth; ++i) node = node->asGroup()->getChild(0);
        const osg::ref_ptr<osg::ClusterCullingCallback> cluster = new osg::ClusterCullingCallback;
        cluster->setRadius(-1.0f);
        cluster->setDeviation(2.0f);  // more than any
        node->setCullCallback(cluster);
        CullView view = RidgeGlobe::alongRow();
        view.cullingMode |= osg::CullSettings::CLUSTER_CULLING;
        for (const bool isKept : {false, true}) {
            CullOptions options = optionsOf("occlusion=on");
            options.cluster = isKept ? ClusterUse::Keep : ClusterUse::Replace;
            installBins(*globe.root, options);
            EXPECT_EQ(globe.draws(*globe.row[2], view), !isKept) << depth;
            EXPECT_EQ(globe.drawsFarTile(view), isKept) << depth;
        }
    }
}

TEST(Evidence, IsMissingForGroundThatHasRisenAboveTheEye) {
    // above all posts, and between them, where the mesh sags
    for (const double altitude : {4000.0, -1000.0}) {
        InstalledGlobe globe;
        const CullView low =
            CullView::lookAt(ecefDeg(22.0, -22.5, altitude), ecefDeg(60.0, 60.0, 0.0), {0, 0, 1}, 60.0);
        for (int i = 0; i < 4; ++i) {
            EXPECT_FALSE(globe.draws(*globe.tiles[15], low)) << altitude;
            EXPECT_GT(globe.counts().hidden, 0u) << altitude;
        }
        takeVertices(*makeMeshTile(extentsDeg(0.0, 45.0, -45.0, 0.0), 20000.0), *globe.tiles[19]);
        for (int i = 0; i < 20; ++i) {
            (void)globe.draws(*globe.tiles[15], low);
            EXPECT_EQ(globe.counts().hidden, 0u) << altitude << ' ' << i;
            update(*globe.root);
        }
    }
}

// All but a peak of the tile below the eye.
TEST(Evidence, IsMissingForGroundThatHasRisenAboveTheEyeBeforeBinsAreInstalledAgain) {
    RidgeGlobe globe;
    osg::Geometry& geometry = *drawableOf(*globe.row[0])->asGeometry();
    auto& vertices = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    const osg::Vec3 up = ecefDeg(0.1, 0.1, 3000.0) - ecefDeg(0.1, 0.1, 0.0);
    vertices[0] += up;
    installBins(*globe.root);
    const CullView view = CullView::lookAt(ecefDeg(0.11, 0.11, 1000.0), {0, 0, 0}, {0, 0, 1}, 100.0);
    (void)globe.drawsFarTile(view);
    EXPECT_GT(globe.counts().hidden, 0u);
    for (unsigned int i = 1; i < vertices.size(); ++i) vertices[i] += up;
    vertices.dirty();
    geometry.dirtyBound();
    installBins(*globe.root);
    (void)globe.drawsFarTile(view);
    EXPECT_EQ(globe.counts().hidden, 0u);
}

// Installs bins on the globe with a mesh of these posts below the eye, row by row from the south.
void installOverGround(RidgeGlobe& globe, unsigned int posts, const std::function<osg::Vec3d(unsigned int)>& post) {
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extentsDeg(0.0, 0.2, 0.0, 0.2), 0.0, posts);
    osg::Vec3Array& vertices = verticesOf(*mesh);
    for (unsigned int i = 0; i < vertices.size(); ++i) vertices[i] = post(i) * osg::Matrixd::inverse(mesh->getMatrix());
    globe.row[0]->setChild(0, mesh);
    installBins(*globe.root);
}

// What a visitor has read of the ground in the views before is the ground below the eye, wherever the eye goes.
TEST(Evidence, OfRoughGroundIsTheSameForAnEyeThatWandersAndForOneThatWasNeverThere) {
    constexpr unsigned int kPostsASide = 33;
    constexpr double kCell = 0.2 / (kPostsASide - 1);
    Random random(77);
    RidgeGlobe globe;
    installOverGround(globe, kPostsASide, [&](unsigned int i) {
        return ecefDeg(kCell * (i / kPostsASide), kCell * (i % kPostsASide), random.uniform(0.0, 3000.0));
    });
    double north = 0.1, east = 0.1;
    int above = 0, below = 0;
    for (int view = 0; view < 400; ++view) {
        // steps of a part of a cell, and of some cells now and then
        const double step = (view % 20 == 0 ? 8.0 : 0.3) * kCell;
        north = std::clamp(north + random.uniform(-step, step), 0.01, 0.19);
        east = std::clamp(east + random.uniform(-step, step), 0.01, 0.19);
        const osg::Vec3d eye = ecefDeg(north, east, random.uniform(500.0, 2500.0));
        const CullView down = CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 100.0);
        (void)globe.drawsFarTile(down);
        const bool isAbove = globe.counts().hidden > 0;
        ++(isAbove ? above : below);
        const osg::ref_ptr<osgUtil::CullVisitor> newcomer = new osgUtil::CullVisitor;
        (void)cull(*globe.root, down, *newcomer, ++globe.frame);
        EXPECT_EQ(isAbove, BinStatistics::of(*newcomer).getCounts().hidden > 0) << view;
    }
    EXPECT_GT(above, 50);
    EXPECT_GT(below, 50);
}

// A rock hangs over the plain. From one view to the next the eye gets into it, above the same triangle of the plain.
TEST(Evidence, IsMissingWithinARockThatHangsOverTheGround) {
    constexpr unsigned int kPostsASide = 9;
    constexpr double kCell = 0.025, kTop = 3000.0, kWithin = 2500.0;
    RidgeGlobe globe;
    installOverGround(globe, kPostsASide, [](unsigned int i) {
        const unsigned int column = i % kPostsASide;
        const double east = column == 5 ? 2.5 : column == 6 ? 6.0 : column;
        return ecefDeg(i / kPostsASide * kCell, east * kCell, column == 5 || column == 6 ? kTop : 0.0);
    });
    for (const auto& [columns, isInRock] : {std::pair(2.1, false), std::pair(2.9, true), std::pair(2.1, false)}) {
        const osg::Vec3d eye = ecefDeg(4.05 * kCell, columns * kCell, kWithin);
        (void)globe.drawsFarTile(CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 100.0));
        EXPECT_EQ(globe.counts().hidden == 0u, isInRock) << columns;
    }
}

// A globe with a file below the tile on its other side.
struct AntipodeFile : MeshGlobe {
    AntipodeFile() {
        tiles[15]->setRange(1, 0.0f, 1e10f);
        putBelow(*tiles[15], file);
        installBins(*root);
    }
    // Adds a model that the horizon hides.
    void add(osg::Node& model) {
        file->addChild(&model);
        for (int i = 0; i < 2; ++i) {
            EXPECT_FALSE(draws(*file, fromAbove())) << i;
            update(*root);
        }
    }

    const osg::Vec3d antipode = ecefDeg(-22.5, 157.5, 0.0);
    const osg::ref_ptr<osg::Group> file = new osg::Group;
};

// The system may give a new object the address of one that was taken away.
TEST(WhatIgnoresDepth, IsToldFromWhatStoodAtItsAddress) {
    AntipodeFile globe;
    const osg::ref_ptr<osg::Node> tower = makeTower(globe.antipode);
    const auto makeModel = [&tower] {
        const osg::ref_ptr<osg::Group> model = new osg::Group;
        model->addChild(tower);
        return model;
    };
    osg::ref_ptr<osg::Group> model = makeModel();
    globe.add(*model);
    const osg::Group* const before = model;
    globe.file->removeChild(model);
    model = nullptr;
    std::vector<osg::ref_ptr<osg::Group>> others;
    for (int i = 0; i < 1000 && model != before; ++i) others.push_back(model = makeModel());
    ignoreDepth(*model);
    (void)model->getBound();
    globe.file->addChild(model);
    EXPECT_TRUE(globe.draws(*tower, MeshGlobe::fromAbove()));
}

TEST(WhatIgnoresDepth, IsNoticedInAModelWhoseBoundIsSaidToHaveChanged) {
    AntipodeFile globe;
    const osg::ref_ptr<osg::Node> model = makeTower(globe.antipode);
    globe.add(*model);
    ignoreDepth(*model);
    model->dirtyBound();
    EXPECT_TRUE(globe.draws(*model, MeshGlobe::fromAbove()));
}

struct FarBound : osg::Node::ComputeBoundingSphereCallback {
    osg::BoundingSphere computeBound(const osg::Node&) const override { return {osg::Vec3(1e8f, 0.0f, 0.0f), 1.0f}; }
};

// OSG leaves it out by that sphere, unless it is its own visitor, for which meshes are drawn directly.
TEST(SpheresOfMeshes, MayBeElsewhereBecauseOfAPart) {
    struct Visitor : osgUtil::CullVisitor {};
    const CullView view = downTo(22.5, 0.0);  // tile 20 is not in it as a whole
    for (const bool isElsewhere : {false, true}) {
        MeshGlobe globe;
        globe.visitor = new Visitor;
        osg::Node& part = *globe.tiles[20]->getChild(0)->asGroup()->getChild(0);
        if (isElsewhere) part.setComputeBoundingSphereCallback(new FarBound);
        part.dirtyBound();
        installBins(*globe.root);
        update(*globe.root);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(globe.draws(*globe.tiles[15], view), isElsewhere) << i;
    }
}

// A camera whose near and far planes OSG computes, with a scene of a globe and something beside it.
struct ComputedPlanes {
    explicit ComputedPlanes(const CullOptions& options = optionsOf("occlusion=on")) {
        scene->addChild(globe.root);
        globe.scene = scene;
        computeNear(view, *scene);
        globe.visitor->setNearFarRatio(1e-5);
        installBins(*globe.root, options);
    }

    [[nodiscard]] bool hidesFarTile() { return !globe.drawsFarTile(view); }

    // At a distance ahead of the eye, in metres.
    [[nodiscard]] osg::ref_ptr<osg::Geometry> drawableAhead(double distance) const {
        const osg::Vec3 point(osg::Vec3d(0.0, 0.0, -distance) * osg::Matrixd::inverse(view.modelView));
        return makeGeometry(new osg::Vec3Array(1, &point), new osg::DrawArrays(GL_POINTS, 0, 1));
    }

    RidgeGlobe globe;
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    CullView view = RidgeGlobe::alongRow();
};

// The plane is where OSG puts it when all is drawn that is not hidden, not where it would be with less.
TEST(ComputedNear, LeavesWhatIsHiddenWhereThePlaneIsNear) {
    ComputedPlanes planes;
    EXPECT_TRUE(planes.hidesFarTile());
    planes.globe.visitor->setNearFarRatio(0.05);  // the ridge is in front of it
    EXPECT_FALSE(planes.hidesFarTile());
    planes.globe.visitor->setNearFarRatio(1e-5);
    EXPECT_TRUE(planes.hidesFarTile());
    planes.scene->addChild(planes.drawableAhead(1e6));
    EXPECT_TRUE(planes.hidesFarTile());
    // planes of their own
    const osg::ref_ptr<osg::Camera> overlay = new osg::Camera;
    overlay->addChild(planes.drawableAhead(1e10));
    planes.scene->addChild(overlay);
    EXPECT_TRUE(planes.hidesFarTile());
    // OSG moves an oblique plane along the look direction
    planes.view.projection(0, 2) = 0.1;
    EXPECT_FALSE(planes.hidesFarTile());
}

// A camera's own callback may draw anything, unless it is declared.
TEST(ComputedNear, IsNotKnownBelowACameraWithACallback) {
    ComputedPlanes planes;
    const osg::ref_ptr<Before> callback = new Before;
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
        osg::ref_ptr<osg::CoordinateSystemNode> root = makeGlobe({tiles});
        if (isTerrain) {
            root = new osgTerrain::Terrain;
            root->setEllipsoidModel(new osg::EllipsoidModel);
            root->addChild(tiles);
        }
        planes.scene->replaceChild(planes.globe.root, root);
        planes.globe.root = root;
        installBins(*root, optionsOf("occlusion=on"));
        if (!isTerrain) root->addCullCallback(new osg::NodeCallback);
        EXPECT_TRUE(planes.hidesFarTile()) << isTerrain;
        root->addChild(planes.drawableAhead(1e10));
        EXPECT_FALSE(planes.hidesFarTile()) << isTerrain;
    }
}

// Thousands of models that OSG leaves out at once, by their spheres or as levels that are too far.
TEST(ComputedNear, DoesNotDependOnWhatOsgDoesNotEnter) {
    struct Unknown : osg::Group {};
    ComputedPlanes planes;
    const osg::ref_ptr<osg::Group> stranger = new Unknown;
    for (int i = 0; i < 2000; ++i) stranger->addChild(planes.drawableAhead(-1e5));
    planes.scene->addChild(makeGroup({stranger}));
    EXPECT_TRUE(planes.hidesFarTile());
    // a node of this class may move before OSG tests its sphere
    planes.scene->addChild(stranger);
    EXPECT_FALSE(planes.hidesFarTile());
    planes.scene->removeChild(stranger);
    // in view
    const osg::ref_ptr<osg::LOD> levels = new osg::LOD;
    levels->addChild(makeGroup({planes.drawableAhead(1e10), new Unknown}), 5e9f, 2e10f);
    const osg::Vec3d center = levels->getChild(0)->getBound().center();
    planes.scene->addChild(makeTransform(osg::Matrixd::translate(center * -0.9), {levels}));
    EXPECT_TRUE(planes.hidesFarTile());
    levels->setRange(0, 0.0f, 2e10f);
    EXPECT_FALSE(planes.hidesFarTile());
}

TEST(ComputedNear, IsUnknownBesideWhatIsUnknown) {
    struct Unknown : osg::Group {};
    for (const bool isClass : {true, false}) {
        ComputedPlanes planes;
        const osg::ref_ptr<osg::Group> beside = isClass ? new Unknown : new osg::Group;
        beside->setName("the stranger");
        if (!isClass) beside->setCullCallback(new Before);
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

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What applications do with a globe on which bins are installed: instances, content of their own, clones, state, masks.
// Oracle: what OSG draws of the same scene; random scenes of all of this: tests/scenes.

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/BinInstaller.h>

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osg/Switch>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgUtil/UpdateVisitor>

#include <functional>
#include <support/CapturedNotes.h>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

osg::Drawable* drawableOf(osg::Node& node) {
    if (osg::Drawable* drawable = node.asDrawable()) return drawable;
    osg::Group* group = node.asGroup();
    return group && group->getNumChildren() > 0 ? drawableOf(*group->getChild(0)) : nullptr;
}

void update(osg::Node& scene) {
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    scene.accept(*visitor);
}

// Of a drawable in a place: ECEF.
osg::ref_ptr<osg::MatrixTransform> makeTower(const osg::Vec3d& place, float size = 50.0f) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-1, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)}) {
        vertices->push_back(v * size);
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    osg::ref_ptr<osg::MatrixTransform> tower = new osg::MatrixTransform(osg::Matrixd::translate(place));
    tower->addChild(geode);
    return tower;
}

// 32 tiles of 45 degrees, each a PagedLOD whose finer file never comes.
struct MeshGlobe {
    explicit MeshGlobe(double altitude = 0.0) {
        root->setEllipsoidModel(new osg::EllipsoidModel);
        for (int i = 0; i < 32; ++i) {
            const double south = -90.0 + 45.0 * (i / 8);
            const double west = -180.0 + 45.0 * (i % 8);
            tiles.push_back(
                makePaged(makeMeshTile(extentsDeg(south, south + 45, west, west + 45), altitude), "no.osgb"));
            root->addChild(tiles.back());
        }
    }

    [[nodiscard]] bool draws(osg::Node& content, const CullView& view) {
        return cull(*scene, view, *visitor, ++frame).drawn.count(drawableOf(content)) > 0;
    }
    // From 500 km above the middle of tile 19, which looks down.
    [[nodiscard]] static CullView fromAbove(double altitude = 5e5) {
        return CullView::lookAt(ecefDeg(22.5, -22.5, altitude), {0, 0, 0}, {0, 0, 1}, 100.0);
    }
    [[nodiscard]] bool drawsAntipode(double altitude = 5e5) { return draws(*tiles[15], fromAbove(altitude)); }

    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::Group> scene = root;
    std::vector<osg::ref_ptr<osg::PagedLOD>> tiles;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

CullView downTo(double latitude, double longitude, double altitude = 5e5, double fovDeg = 20.0) {
    return CullView::lookAt(ecefDeg(latitude, longitude, altitude), ecefDeg(latitude, longitude, 0), {0, 0, 1}, fovDeg);
}

TEST(Instances, AreDrawnInAllOfTheirPlaces) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::PagedLOD> instance = makePaged(makeMeshTile(extentsDeg(0, 5, 0, 5), 4000.0), "no.osgb");
    for (const double turn : {0.0, 120.0}) {
        const osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::rotate(osg::DegreesToRadians(turn), 0, 0, 1));
        place->addChild(instance);
        globe.root->addChild(place);
    }
    for (const bool isInstalled : {false, true}) {
        if (isInstalled) installBins(*globe.root);
        EXPECT_TRUE(globe.draws(*instance, downTo(2.5, 2.5))) << isInstalled;
        EXPECT_TRUE(globe.draws(*instance, downTo(2.5, 122.5))) << isInstalled;
    }
    EXPECT_FALSE(globe.drawsAntipode());
}

TEST(Instances, ThatAreMadeLaterAreDrawnInAllOfTheirPlaces) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::PagedLOD> instance = makePaged(makeMeshTile(extentsDeg(0, 5, 0, 5), 4000.0), "no.osgb");
    globe.root->addChild(instance);
    installBins(*globe.root);
    const osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::rotate(osg::DegreesToRadians(120.0), 0, 0, 1));
    place->addChild(instance);
    globe.root->addChild(place);
    EXPECT_TRUE(globe.draws(*instance, downTo(2.5, 2.5)));
    EXPECT_TRUE(globe.draws(*instance, downTo(2.5, 122.5)));
}

// A root tile of 40 degrees, and a file below it: the application's plain group with one leaf.
struct FiledGlobe : MeshGlobe {
    FiledGlobe() {
        const osg::ref_ptr<osg::Group> file = new osg::Group;
        file->addChild(makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0));
        EXPECT_TRUE(osgDB::writeNodeFile(*file, folder / "group.osgb"));
        tile = makePaged(makeMeshTile(extentsDeg(10, 50, 0, 40), 200.0), "group.osgb", 1e9f);
        tile->setDatabasePath(std::string(folder / ""));
        root->removeChildren(0, root->getNumChildren());
        root->addChild(tile);
        installBins(*root);
        group = readBelow(*tile)->asGroup();
        putBelow(*tile, group);
        update(*root);
    }

    TemporaryFolder folder;
    osg::ref_ptr<osg::PagedLOD> tile;
    osg::ref_ptr<osg::Group> group;
};

// Level, high above the terrain: only what stands in the air there is in the picture.
CullView beside(const osg::Vec3d& place) {
    const osg::Vec3d up = place / place.length();
    osg::Vec3d east = osg::Vec3d(0, 0, 1) ^ up;
    east.normalize();
    return CullView::lookAt(place - east * 5000.0, place, up, 2.0);
}

TEST(AddedContent, OfAnApplicationsGroupIsDrawnAtOnce) {
    FiledGlobe globe;
    EXPECT_EQ(globe.group->getCullCallback(), nullptr) << "the application's group is no tile";
    const osg::ref_ptr<osg::Node> vehicle = makeTower(ecefDeg(20, 20, 30000.0));
    globe.group->addChild(vehicle);
    EXPECT_TRUE(globe.draws(*vehicle, beside(ecefDeg(20, 20, 30000.0))));
    update(*globe.root);
    EXPECT_TRUE(globe.draws(*vehicle, beside(ecefDeg(20, 20, 30000.0))));
    // and follows it
    vehicle->asTransform()->asMatrixTransform()->setMatrix(osg::Matrixd::translate(ecefDeg(20, 60, 1000.0)));
    EXPECT_TRUE(globe.draws(*vehicle, downTo(20, 60, 3000.0, 5.0)));
    update(*globe.root);
    EXPECT_TRUE(globe.draws(*vehicle, downTo(20, 60, 3000.0, 5.0)));
}

TEST(AddedContent, BelowATileWidensItsBinAndThoseAbove) {
    FiledGlobe globe;
    osg::Group* const leaf = globe.group->getChild(0)->asGroup();
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Node> tower =
        makeTower(place * osg::Matrixd::inverse(leaf->getChild(0)->getWorldMatrices()[0]));
    const CullView view = beside(place);
    EXPECT_FALSE(globe.draws(*leaf, view));
    leaf->getChild(0)->asGroup()->addChild(tower);
    EXPECT_TRUE(globe.draws(*tower, view));
    update(*globe.root);
    EXPECT_TRUE(globe.draws(*tower, view));
    EXPECT_GE(installedOn(*globe.tile)->bin().bin().altitude().upper, 30000.0);
    EXPECT_LE(installedOn(*globe.tile)->bin().bin().altitude().upper, 31000.0);
    // the tiles are culled by what they hold now
    EXPECT_FALSE(globe.draws(*tower, beside(ecefDeg(20, 20, 60000.0))));
    EXPECT_FALSE(globe.draws(*leaf, downTo(20, 80, 1e5, 5.0)));
}

TEST(AddedContent, OfAPagedTileItselfIsDrawn) {
    FiledGlobe globe;
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    globe.tile->addChild(tower, 0.0f, 1e10f);
    EXPECT_TRUE(globe.draws(*tower, beside(place)));
    update(*globe.root);
    EXPECT_TRUE(globe.draws(*tower, beside(place)));
}

TEST(AddedContent, ThatCameWithAFileIsDrawn) {
    FiledGlobe globe;
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    file->addChild(makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0));
    const osg::ref_ptr<osg::MatrixTransform> written = makeTower(place);
    written->setDataVariance(osg::Object::DYNAMIC);
    file->addChild(written);
    ASSERT_TRUE(osgDB::writeNodeFile(*file, globe.folder / "group.osgb"));
    pageOut(*globe.tile);
    const osg::ref_ptr<osg::Node> content = readBelow(*globe.tile);
    // as the pager does before it merges a file
    (void)content->getBound();
    putBelow(*globe.tile, content);
    osg::Node& tower = *content->asGroup()->getChild(1);
    EXPECT_TRUE(globe.draws(tower, beside(place)));
    update(*globe.root);
    EXPECT_TRUE(globe.draws(tower, beside(place)));
}

TEST(AddedContent, IsHeldByBinsThatAreInstalledAgain) {
    FiledGlobe globe;
    osg::Node& leaf = *globe.group->getChild(0)->asGroup()->getChild(0);
    setStoredBin(*globe.tile, AnalyticBin(extentsDeg(10, 50, 0, 40).withAltitude({-40000, 300})));
    installBins(*globe.root);
    // within what coarse meshes are allowed to leave a stored bin by
    const osg::Vec3d place = ecefDeg(20, 20, 2000.0);
    const osg::ref_ptr<osg::Node> tower = makeTower(place * osg::Matrixd::inverse(leaf.getWorldMatrices()[0]));
    leaf.asGroup()->addChild(tower);
    for (int round = 0; round < 2; ++round) {
        installBins(*globe.root);
        update(*globe.root);
        const osg::Vec3d up = place / place.length();
        osg::Vec3d east = osg::Vec3d(0, 0, 1) ^ up;
        east.normalize();
        // from below, so that the terrain is outside
        const CullView view = CullView::lookAt(place - east * 5000.0 - up * 300.0, place, up, 2.0);
        EXPECT_TRUE(globe.draws(*tower, view)) << round;
    }
}

TEST(AddedContent, IsKnownToASceneThatIsSavedAtOnce) {
    FiledGlobe globe;
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    globe.group->addChild(makeTower(place));
    ASSERT_TRUE(osgDB::writeNodeFile(*globe.root, globe.folder / "saved.osgb"));
    const osg::ref_ptr<osg::Node> back = osgDB::readRefNodeFile(globe.folder / "saved.osgb");
    ASSERT_TRUE(back);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    EXPECT_EQ(cull(*back, beside(place), *visitor).drawn.size(), 1u);
}

// A Terrain of 32 flat osgTerrain tiles below PagedLODs.
osg::ref_ptr<osgTerrain::Terrain> makeTerrain() {
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    for (int i = 0; i < 32; ++i) {
        const double south = -90.0 + 45.0 * (i / 8);
        const double west = -180.0 + 45.0 * (i % 8);
        terrain->addChild(makePaged(makeFlatTile(extentsDeg(south, south + 45, west, west + 45), 3000.0f), "no.osgb"));
    }
    return terrain;
}

std::size_t tilesDrawn(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    return cull(scene, view, *visitor).drawn.size();
}

TEST(Clones, OfADatabaseAreCulledByTheirOwnShape) {
    const osg::ref_ptr<osgTerrain::Terrain> terrain = makeTerrain();
    // looks over the tile at 3 km, up to where it is at scale 10
    const CullView view =
        CullView::lookAt(ecefDeg(22.5, -22.5, 60000.0), ecefDeg(23.5, -22.5, 31000.0), ecefDeg(22.5, -22.5, 0.0), 2.0);
    installBins(*terrain);
    const osg::ref_ptr<osgTerrain::Terrain> clone =
        osg::clone(terrain.get(), osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_CALLBACKS);
    clone->setVerticalScale(10.0f);
    osg::Node& tile = *clone->getChild(19);
    std::set<std::string> visited;
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    tile.asGroup()->getChild(0)->addCullCallback(new VisitRecorder("tile", visited));
    (void)cull(*clone, view, *visitor);
    EXPECT_EQ(visited.count("tile"), 1u) << "before the clone has a database of its own";
    update(*clone);
    ASSERT_NE(installedOn(tile), nullptr);
    ASSERT_TRUE(installedOn(tile)->terrainShape().has_value());
    EXPECT_EQ(installedOn(tile)->terrainShape()->verticalScale, 10.0);
    visited.clear();
    (void)cull(*clone, view, *visitor);
    EXPECT_EQ(visited.count("tile"), 1u);
    visited.clear();
    (void)cull(*clone, CullView::lookAt(ecefDeg(22.5, 157.5, 60000.0), ecefDeg(22.5, 157.5, 0.0), {0, 0, 1}, 20.0),
               *visitor);
    EXPECT_EQ(visited.count("tile"), 0u) << "the clone is culled by its own bins";
    // the original keeps its own
    EXPECT_EQ(installedOn(*terrain->getChild(19))->terrainShape()->verticalScale, 1.0);
}

TEST(Clones, ThatShareCallbacksStayVisible) {
    MeshGlobe globe;
    // what is drawn is told by bins alone
    for (const auto& tile : globe.tiles) drawableOf(*tile)->setCullingActive(false);
    installBins(*globe.root);
    const osg::ref_ptr<osg::Group> clone = osg::clone(globe.root.get(), osg::CopyOp::DEEP_COPY_NODES);
    EXPECT_LT(tilesDrawn(*globe.root, downTo(22.5, -22.5)), 8u);
    EXPECT_EQ(tilesDrawn(*clone, downTo(22.5, -22.5)), 32u);
    update(*clone);
    update(*globe.root);
    EXPECT_EQ(installBins(*clone, CullOptions()), 32u);
    EXPECT_LT(tilesDrawn(*clone, downTo(22.5, -22.5)), 8u);
}

TEST(SeeThroughTerrain, HidesNothing) {
    const auto setPolygonMode = [](osg::StateSet& state) {
        state.setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
    };
    const auto setTransparent = [](osg::StateSet& state) { state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN); };
    const auto setAlphaTest = [](osg::StateSet& state) { state.setAttributeAndModes(new osg::AlphaFunc); };
    const auto setNoDepthTest = [](osg::StateSet& state) { state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF); };
    const auto setClipPlane = [](osg::StateSet& state) { state.setMode(GL_CLIP_PLANE2, osg::StateAttribute::ON); };
    const std::vector<std::function<void(osg::StateSet&)>> states{setPolygonMode, setTransparent, setAlphaTest,
                                                                  setNoDepthTest, setClipPlane};
    for (std::size_t i = 0; i < states.size(); ++i) {
        MeshGlobe globe;
        globe.scene = new osg::Group;
        globe.scene->addChild(globe.root);
        installBins(*globe.root);
        EXPECT_FALSE(globe.drawsAntipode());
        // above the database, on it, and on a tile
        for (osg::Node* node : {static_cast<osg::Node*>(globe.scene), static_cast<osg::Node*>(globe.root),
                                static_cast<osg::Node*>(globe.tiles[19])}) {
            states[i](*node->getOrCreateStateSet());
            EXPECT_TRUE(globe.drawsAntipode()) << i;
            node->setStateSet(nullptr);
            EXPECT_FALSE(globe.drawsAntipode()) << i;
        }
        // in a mesh that bins are installed on
        states[i](*drawableOf(*globe.tiles[19])->getOrCreateStateSet());
        installBins(*globe.root);
        EXPECT_TRUE(globe.drawsAntipode()) << i;
    }
}

TEST(SeeThroughTerrain, IsNotWhatIsFilled) {
    MeshGlobe globe;
    osg::StateSet& state = *globe.root->getOrCreateStateSet();
    state.setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::FILL));
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
    state.setMode(GL_ALPHA_TEST, osg::StateAttribute::OFF);
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
}

// Leaves its node out.
struct Pruner : osg::NodeCallback {
    void operator()(osg::Node*, osg::NodeVisitor*) override {}
};

TEST(HoledGlobe, IsSeenThrough) {
    const auto mask = [](MeshGlobe& globe) { globe.tiles[19]->setNodeMask(0); };
    const auto prune = [](MeshGlobe& globe) { globe.tiles[19]->addCullCallback(new Pruner); };
    const auto shrink = [](MeshGlobe& globe) {
        for (unsigned int i = 0; i < globe.tiles[19]->getNumRanges(); ++i) globe.tiles[19]->setRange(i, 0.0f, 1.0f);
    };
    const auto switchOff = [](MeshGlobe& globe) {
        const osg::ref_ptr<osg::Switch> off = new osg::Switch;
        globe.root->replaceChild(globe.tiles[19], off);
        off->addChild(globe.tiles[19], false);
    };
    const std::vector<std::function<void(MeshGlobe&)>> ways{mask, prune, shrink, switchOff};
    for (std::size_t i = 0; i < ways.size(); ++i) {
        for (const bool isDeclared : {false, true}) {
            CullOptions options;
            if (isDeclared) options.horizonUse = HorizonUse::Given;
            if (isDeclared) options.horizon = -50000.0;
            MeshGlobe globe;
            installBins(*globe.root, options);
            EXPECT_FALSE(globe.drawsAntipode());
            ways[i](globe);
            EXPECT_TRUE(globe.drawsAntipode()) << i << isDeclared;
            installBins(*globe.root, options);
            EXPECT_TRUE(globe.drawsAntipode()) << i << isDeclared;
        }
    }
}

TEST(HoledGlobe, IsSeenThroughBelowTilesThatAreHigherThanTheOccluder) {
    MeshGlobe globe(40000.0);
    const osg::ref_ptr<osg::PagedLOD> finer =
        makePaged(makeMeshTile(extentsDeg(0, 45, -45, 0), 40000.0), "no.osgb", 1.0f);
    globe.tiles[19]->setRange(0, 1e9f, 1e10f);
    globe.tiles[19]->setRange(1, 0.0f, 1e9f);
    putBelow(*globe.tiles[19], finer);
    CullOptions options;
    options.heights = {30000.0, 50000.0};
    installBins(*globe.root, options);
    EXPECT_FALSE(globe.drawsAntipode());
    finer->setNodeMask(0);
    EXPECT_TRUE(globe.drawsAntipode());
}

TEST(HoledGlobe, IsNotOneWithCallbacksThatPromiseToTraverse) {
    MeshGlobe globe;
    std::set<std::string> visited;
    const osg::ref_ptr<osg::NodeCallback> callback = new VisitRecorder("tile", visited);
    setTraversesAlways(*callback);
    globe.tiles[19]->setCullCallback(callback);
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    EXPECT_EQ(visited.size(), 1u);
}

TEST(UndergroundEyes, AreFoundWhereAGeodeHoldsATransform) {
    MeshGlobe globe(40000.0);
    osg::Geode* const geode = drawableOf(*globe.tiles[19])->getParent(0)->asGeode();
    geode->addChild(makeTower(osg::Vec3d(0, 0, 0)));
    installBins(*globe.root);
    const osg::Vec3d eye = ecefDeg(21.3, -21.7, 30000.0);
    EXPECT_TRUE(globe.draws(*globe.tiles[15], CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 100.0)));
}

TEST(SavedScenes, HideNothingBehindTheHorizonWithoutTheirDatabase) {
    CullOptions options;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -50000.0;
    MeshGlobe globe;
    installBins(*globe.root, options);
    AnalyticBinCullCallback& callback = *installedOn(*globe.tiles[15]);
    const osg::ref_ptr<AnalyticBinCullCallback> read = new AnalyticBinCullCallback;
    read->setOptionsText(callback.getOptionsText());
    read->setBinText(callback.getBinText());
    EXPECT_TRUE(read->bin().valid());
    const osg::ref_ptr<osg::CoordinateSystemNode> back = new osg::CoordinateSystemNode;
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->addChild(makeMeshTile(extentsDeg(-45, 0, 135, 180), 0.0));
    tile->setCullCallback(read);
    tile->setCullingActive(false);
    back->addChild(tile);
    globe.scene = back;
    EXPECT_TRUE(globe.draws(*tile, MeshGlobe::fromAbove()));
}

TEST(UndergroundEyes, HaveNoHorizon) {
    for (const bool isDeclared : {false, true}) {
        CullOptions options;
        if (isDeclared) options.horizonUse = HorizonUse::Given;
        if (isDeclared) options.horizon = -50000.0;
        MeshGlobe globe(40000.0);
        installBins(*globe.root, options);
        const auto drawsAntipode = [&](double altitude) {
            const osg::Vec3d eye = ecefDeg(21.3, -21.7, altitude);
            return globe.draws(*globe.tiles[15], CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 100.0));
        };
        EXPECT_FALSE(drawsAntipode(41000.0));
        EXPECT_TRUE(drawsAntipode(20000.0)) << isDeclared;
        // again, with what was found below the eye before
        EXPECT_FALSE(drawsAntipode(41000.0));
        EXPECT_FALSE(drawsAntipode(40900.0));
        EXPECT_TRUE(drawsAntipode(20000.0)) << isDeclared;
    }
}

TEST(Undo, RestoresAllThatWasChanged) {
    MeshGlobe globe;
    osg::PagedLOD& tile = *globe.tiles[19];
    osg::Node& mesh = *tile.getChild(0);
    mesh.setCullingActive(false);
    globe.tiles[18]->setCullingActive(false);
    const osg::ref_ptr<osgDB::Options> own = new osgDB::Options("own");
    tile.setDatabaseOptions(own);
    const osg::ref_ptr<osg::NodeCallback> user = new osg::NodeCallback;
    tile.setCullCallback(user);
    tile.setMinimumExpiryTime(1, 2.0);
    struct Bound : osg::Node::ComputeBoundingSphereCallback {
        osg::BoundingSphere computeBound(const osg::Node& node) const override { return node.computeBound(); }
    };
    const osg::ref_ptr<Bound> bound = new Bound;
    tile.setComputeBoundingSphereCallback(bound);

    for (int round = 0; round < 3; ++round) {
        installBins(*globe.root);
        installBins(*globe.root);
        EXPECT_FALSE(tile.getCullingActive());
        const osg::ref_ptr<osg::Node> tower = makeTower(ecefDeg(20, -20, 1000.0));
        tower->setCullingActive(false);
        if (round == 2) mesh.asGroup()->addChild(tower);
        removeBins(*globe.root);
        EXPECT_FALSE(mesh.getCullingActive());
        EXPECT_FALSE(tower->getCullingActive());
        EXPECT_FALSE(globe.tiles[18]->getCullingActive());
        EXPECT_TRUE(globe.tiles[18]->getChild(0)->getCullingActive());
        EXPECT_TRUE(tile.getCullingActive());
        EXPECT_EQ(tile.getDatabaseOptions(), own);
        EXPECT_EQ(globe.tiles[18]->getDatabaseOptions(), nullptr);
        EXPECT_EQ(tile.getCullCallback(), user);
        EXPECT_EQ(user->getNestedCallback(), nullptr);
        EXPECT_EQ(tile.getMinimumExpiryTime(1), 2.0);
        EXPECT_EQ(tile.getComputeBoundingSphereCallback(), bound);
        EXPECT_EQ(tile.getUserDataContainer(), nullptr);
        EXPECT_EQ(globe.root->getCullCallback(), nullptr);
        EXPECT_EQ(globe.root->getUpdateCallback(), nullptr);
    }
}

TEST(Undo, TakesGroupsAboveTilesAway) {
    FiledGlobe globe;
    ASSERT_NE(globe.group->getChild(0)->asTransform(), globe.group->getChild(0)) << "a group is above the leaf";
    removeBins(*globe.root);
    EXPECT_NE(globe.group->getChild(0)->asTransform(), nullptr);
    EXPECT_EQ(globe.group->getNumChildren(), 1u);
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
struct MaskReader : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        mask = nv->asCullStack()->getCurrentCullingSet().getFrustum().getCurrentMask();
        traverse(node, nv);
    }
    osg::Polytope::ClippingMask mask = 99;
};

TEST(DecidedPlanes, AreInheritedByChildrenAndNotBySiblings) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    // a model in view before the tiles: OSG leaves its decided planes behind
    root->addChild(makeTower(ecefDeg(0.5, 0.5, 1000.0)));
    std::vector<osg::ref_ptr<MaskReader>> readers;
    for (const auto& extents : {extentsDeg(0, 1, 0, 1), extentsDeg(0, 1, 20, 60)}) {
        const osg::ref_ptr<osg::Group> tile = new osg::Group;
        const osg::ref_ptr<osg::Group> child = new osg::Group;
        readers.push_back(new MaskReader);
        child->setCullCallback(readers.back());
        child->setCullingActive(false);
        tile->addChild(child);
        tile->addChild(makeTower(ecefDeg(0.5, 0.5, 0.0)));
        setStoredBin(*tile, AnalyticBin(extents.withAltitude({-100, 100})));
        root->addChild(tile);
    }
    ASSERT_EQ(installBins(*root), 2u);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const CullView view = CullView::lookAt(ecefDeg(0.5, 0.5, 5e6), ecefDeg(0.5, 0.5, 0), {0, 0, 1}, 60.0);
    (void)cull(*root, view, *visitor);
    EXPECT_EQ(readers[0]->mask, 0u) << "the first tile is inside all planes";
    EXPECT_NE(readers[1]->mask, 0u) << "the second is not";
    EXPECT_NE(readers[1]->mask, 99u);
}

}  // namespace
}  // namespace osgAnalyticBin::test

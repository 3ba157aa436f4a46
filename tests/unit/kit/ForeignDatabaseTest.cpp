// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer does to databases of other builders: which nodes get bins, from which heights, and what is given
// back. Their surfaces are tested in TileSurfaceTest.cpp, indexes in StaleIndexTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"
#include "TileFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/Geode>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <support/TemporaryFolder.h>
#include <typeinfo>

namespace osgAnalyticBin::test {
namespace {

bool isWithinHeights(osg::Node& tile, osg::Node& parent) {
    const core::Interval inner = culledBin(*installedOn(tile)).bin().altitude();
    const core::Interval outer = culledBin(*installedOn(parent)).bin().altitude();
    return outer.lower <= inner.lower && inner.upper <= outer.upper;
}

CullOptions withMethod(Method method, ClusterUse cluster = ClusterUse::Replace) {
    CullOptions options;
    options.method = method;
    options.cluster = cluster;
    return options;
}

// A database on disk, with all of it read as the pager does.
class ForeignDatabase : public ::testing::Test {
protected:
    void load(const CullOptions& options = {}) {
        _scene = osgDB::readRefNodeFile(writeMeshDatabase(_folder.path(), 700.0, 900.0));
        ASSERT_TRUE(_scene);
        _root = dynamic_cast<osg::PagedLOD*>(_scene->asGroup()->getChild(0));
        ASSERT_TRUE(_root);
        EXPECT_EQ(installBins(*_scene, options), options.method == Method::Sphere ? 0u : 1u);
        const osg::ref_ptr<osg::Node> children = readBelow(*_root);
        ASSERT_TRUE(children);
        putBelow(*_root, children);
        _south = children->asGroup()->getChild(0);
        _north = dynamic_cast<osg::PagedLOD*>(children->asGroup()->getChild(1));
        ASSERT_TRUE(_north);
        _single = readBelow(*_north);
        ASSERT_TRUE(_single);
        putBelow(*_north, _single);
    }

    TemporaryFolder _folder;
    osg::ref_ptr<osg::Node> _scene, _south, _single;
    osg::ref_ptr<osg::PagedLOD> _root, _north;
};

TEST_F(ForeignDatabase, PagedLodsAndLeavesGetBins) {
    load();
    for (osg::Node* node :
         {static_cast<osg::Node*>(_root), _south.get(), static_cast<osg::Node*>(_north), _single.get()}) {
        ASSERT_NE(installedOn(*node), nullptr);
        EXPECT_TRUE(installedOn(*node)->getBin().valid());
        EXPECT_TRUE(node->getCullingActive());
    }
    // in the scene that is drawn next
    update(*_scene);
    EXPECT_TRUE(isWithinHeights(*_single, *_root));
}

TEST_F(ForeignDatabase, ALeafThatIsATransformGetsAPlainGroupAboveIt) {
    load();
    for (osg::Node* leaf : {_south.get(), _single.get()}) {
        // saved and cloned as that
        EXPECT_STREQ(leaf->className(), "Group");
        EXPECT_STREQ(leaf->libraryName(), "osg");
        ASSERT_EQ(leaf->asGroup()->getNumChildren(), 1u);
        osg::Node& mesh = *leaf->asGroup()->getChild(0);
        EXPECT_NE(mesh.asTransform(), nullptr);
        EXPECT_EQ(mesh.getCullCallback(), nullptr);
        EXPECT_TRUE(mesh.getCullingActive());
        EXPECT_TRUE(installedOn(*leaf)->getLocalToEcef().isIdentity());
    }
    // and no other above that
    EXPECT_EQ(installBins(*_scene), 4u);
    EXPECT_NE(_single->asGroup()->getChild(0)->asTransform(), nullptr);
    EXPECT_EQ(_single->getNumParents(), 1u);
}

TEST_F(ForeignDatabase, HeightsAreThoseOfTheOptionsAndALeafsHighIsItsOwn) {
    CullOptions options;
    options.heights = {-150.0, 5000.0};
    load(options);
    for (osg::Node* node : {static_cast<osg::Node*>(_root), static_cast<osg::Node*>(_north)}) {
        const AnalyticBin& bin = installedOn(*node)->getBin();
        EXPECT_EQ(bin.bin().altitude().upper, 5000.0);
        EXPECT_LE(bin.bin().altitude().lower, -150.0);
        EXPECT_GE(bin.bin().altitude().lower + bin.sag(), -150.001);
    }
    EXPECT_NEAR(installedOn(*_south)->getBin().bin().altitude().upper, 700.0, 1.0);
    EXPECT_NEAR(installedOn(*_single)->getBin().bin().altitude().upper, 900.0, 1.0);
}

TEST_F(ForeignDatabase, InstallingAgainReplacesAndSpheresGiveAllBack) {
    load();
    EXPECT_DOUBLE_EQ(_root->getMinimumExpiryTime(1), CullOptions::kDefaultExpiry);
    EXPECT_EQ(installBins(*_scene, withMethod(Method::Exact)), 4u);
    for (osg::Node* node : {static_cast<osg::Node*>(_root), _south.get(), _single.get()}) {
        ASSERT_NE(installedOn(*node), nullptr);
        EXPECT_EQ(installedOn(*node)->getCullOptions().method, Method::Exact);
        EXPECT_EQ(installedOn(*node)->getNestedCallback(), nullptr);
    }
    EXPECT_EQ(installBins(*_scene, withMethod(Method::Sphere)), 0u);
    for (osg::Node* node : {static_cast<osg::Node*>(_root), _south.get(), static_cast<osg::Node*>(_north),
                            _single.get(), _single->asGroup()->getChild(0)}) {
        EXPECT_EQ(node->getCullCallback(), nullptr);
        EXPECT_TRUE(node->getCullingActive());
    }
    EXPECT_EQ(_root->getMinimumExpiryTime(1), 0.0);
    EXPECT_EQ(_scene->getCullCallback(), nullptr);
    EXPECT_EQ(_scene->getUpdateCallback(), nullptr);
}

// A tile whose PagedLOD and drawable have callbacks that cull whatever the eye, between callbacks of the user.
struct ClusterTile {
    ClusterTile() {
        mesh = makeMeshTile(extentsDeg(0, 20, 0, 20), 0.0);
        drawable = mesh->getChild(0)->asGeode()->getDrawable(0);
        paged = makePaged(mesh, "none.osgb", 1.0f);
        first->setNestedCallback(makeCluster());
        first->getNestedCallback()->setNestedCallback(new VisitRecorder("last", names));
        paged->setCullCallback(first);
        drawable->setCullCallback(makeCluster());
        root->addChild(paged);
    }

    static osg::ClusterCullingCallback* makeCluster() {
        auto* cluster = new osg::ClusterCullingCallback(osg::Vec3(), osg::Vec3(-1, 0, 0), 0.9f);
        cluster->setRadius(5.0f);
        return cluster;
    }

    // What a cull traversal reaches: "first", "last", "drawn".
    std::set<std::string> reached() {
        names.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        CullView view = CullView::lookAt(ecefDeg(10, 10, 5e6), {0, 0, 0}, {0, 0, 1}, 60.0);
        view.cullingMode |= osg::CullSettings::CLUSTER_CULLING;
        const CullResult result = cull(*root, view, *visitor);
        if (result.drawn.count(drawable)) names.insert("drawn");
        EXPECT_TRUE(visitor->getCullingMode() & osg::CullSettings::CLUSTER_CULLING);
        return names;
    }

    std::set<std::string> names;
    const osg::ref_ptr<VisitRecorder> first = new VisitRecorder("first", names);
    osg::ref_ptr<osg::MatrixTransform> mesh;
    osg::ref_ptr<osg::Drawable> drawable;
    osg::ref_ptr<osg::PagedLOD> paged;
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
};

const std::set<std::string> kAll{"first", "last", "drawn"};
const std::set<std::string> kClusterCulled{"first"};

TEST(ClusterCulling, RestsWhileBinsAreInstalled) {
    ClusterTile tile;
    ASSERT_EQ(tile.reached(), kClusterCulled);
    const osg::ref_ptr<osg::Callback> cluster = tile.first->getNestedCallback();
    for (int i = 0; i < 2; ++i) {
        installBins(*tile.root);
        EXPECT_EQ(tile.reached(), kAll);
        EXPECT_EQ(tile.first->getNestedCallback(), cluster);
    }
    installBins(*tile.root, withMethod(Method::None));
    EXPECT_EQ(tile.reached(), kAll);
    installBins(*tile.root, withMethod(Method::Sphere));
    EXPECT_EQ(tile.reached(), kClusterCulled);
    EXPECT_EQ(tile.paged->getCullCallback(), tile.first);
}

TEST(ClusterCulling, RestsInTheMeshOfALeaf) {
    ClusterTile tile;
    const osg::ref_ptr<osg::Group> leaf = new osg::Group;
    leaf->addChild(tile.mesh);
    setStoredBin(*leaf, AnalyticBin(extentsDeg(0, 20, 0, 20).withAltitude({-100000.0, 100.0})));
    tile.root->replaceChild(tile.paged, leaf);
    ASSERT_EQ(tile.reached().count("drawn"), 0u);
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(installBins(*tile.root), 1u);
        EXPECT_EQ(tile.reached().count("drawn"), 1u);
    }
    removeBins(*tile.root);
    EXPECT_EQ(tile.reached().count("drawn"), 0u);
}

TEST(ClusterCulling, StaysWhereItIsToBeKept) {
    ClusterTile tile;
    installBins(*tile.root, withMethod(Method::Quadratic, ClusterUse::Keep));
    EXPECT_EQ(tile.reached(), kClusterCulled);
    EXPECT_EQ(typeid(*tile.first->getNestedCallback()), typeid(osg::ClusterCullingCallback));
}

TEST(ClusterCulling, IsSavedAsWhatItWas) {
    const TemporaryFolder folder;
    ClusterTile tile;
    installBins(*tile.root);
    ASSERT_EQ(tile.reached(), kAll);
    for (const char* name : {"/tile.osgb", "/tile.osgt"}) {
        ASSERT_TRUE(osgDB::writeNodeFile(*tile.mesh, folder.path() + name));
        const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(folder.path() + name);
        ASSERT_TRUE(read);
        osg::Drawable& drawable = *read->asGroup()->getChild(0)->asGeode()->getDrawable(0);
        ASSERT_NE(drawable.getCullCallback(), nullptr);
        const osg::Callback& callback = *drawable.getCullCallback();
        ASSERT_EQ(typeid(callback), typeid(osg::ClusterCullingCallback));
        const auto& cluster = dynamic_cast<const osg::ClusterCullingCallback&>(callback);
        EXPECT_EQ(cluster.getNormal(), osg::Vec3(-1, 0, 0));
        EXPECT_EQ(cluster.getDeviation(), 0.9f);
        EXPECT_EQ(cluster.getRadius(), 5.0f);
    }
}

TEST(ForeignSkirts, AreHeldWholeWhereAllCount) {
    CullOptions options;
    options.skirts = SkirtUse::All;
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    const auto tile = makeFlatTile(extentsDeg(-90, 90, -180, 180), 0.0f, 40000.0f);
    terrain->addChild(tile);
    installBins(*terrain, options);
    const AnalyticBin bin = culledBin(*installedOn(*tile));
    const core::Ellipsoid wgs84(osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR);
    EXPECT_LE(metresOutside(bin, samplesOf(drawnTriangles(*tile, 1.0f).skirts), wgs84), bin.margin());
    EXPECT_EQ(installedOn(*tile)->getSkirt(), 40000.0);
    installBins(*terrain);
    EXPECT_EQ(installedOn(*tile)->getSkirt(), 0.0);
}

TEST(NoTerrain, IsLeftAsItIs) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    const auto extents = extentsDeg(0, 10, 0, 10);
    const osg::ref_ptr<osg::MatrixTransform> moving = new osg::MatrixTransform;
    moving->setDataVariance(osg::Object::DYNAMIC);
    moving->addChild(makePaged(makeMeshTile(extents, 0.0), "a.osgb"));
    const osg::ref_ptr<osg::MatrixTransform> animated = makeMeshTile(extents, 0.0);
    animated->setUpdateCallback(new osg::NodeCallback);
    const osg::ref_ptr<osg::PagedLOD> model = makePaged(animated, "b.osgb");
    const osg::ref_ptr<osg::PagedLOD> satellite = makePaged(makeMeshTile(extents, 3.6e7), "c.osgb");
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(makeMeshTile(extents, 0.0), "d.osgb");
    for (osg::Node* node : {static_cast<osg::Node*>(moving), static_cast<osg::Node*>(model),
                            static_cast<osg::Node*>(satellite), static_cast<osg::Node*>(tile)}) {
        root->addChild(node);
    }
    EXPECT_EQ(installBins(*root), 1u);
    EXPECT_NE(installedOn(*tile), nullptr);
    for (osg::Node* node :
         {static_cast<osg::Node*>(moving), moving->getChild(0), static_cast<osg::Node*>(model),
          static_cast<osg::Node*>(animated), static_cast<osg::Node*>(satellite), satellite->getChild(0)}) {
        EXPECT_EQ(node->getCullCallback(), nullptr);
        EXPECT_TRUE(node->getCullingActive());
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

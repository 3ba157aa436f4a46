// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles of other builders with an osg::ClusterCullingCallback: what becomes of it while bins are installed.

#include "KitTest.h"

#include <typeinfo>

namespace osgAnalyticBin::test {
namespace {

CullOptions withMethod(Method method, ClusterUse cluster = ClusterUse::Replace) {
    CullOptions options;
    options.method = method;
    options.cluster = cluster;
    return options;
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

}  // namespace
}  // namespace osgAnalyticBin::test

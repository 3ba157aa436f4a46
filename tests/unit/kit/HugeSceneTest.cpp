// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Scenes that are deeper than any terrain. The kit's visitors end with the stack that OSG's own traversals need.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kDeep = 1500;  // each call takes several times the stack
#else
constexpr int kDeep = 10000;
#endif

// Nodes each below the one before, the scene at the end. They are taken apart one by one: OSG would do so recursively.
class Chain {
public:
    Chain(const std::function<osg::ref_ptr<osg::Group>(int)>& make, osg::Node* end) {
        for (int i = 0; i < kDeep; ++i) {
            _nodes.push_back(make(i));
            if (i > 0) _nodes[_nodes.size() - 2]->addChild(_nodes.back());
        }
        _nodes.back()->addChild(end);
        root->setEllipsoidModel(new osg::EllipsoidModel);
        root->addChild(_nodes.front());
    }
    ~Chain() {
        root->removeChildren(0, root->getNumChildren());
        for (const auto& node : _nodes) node->removeChildren(0, node->getNumChildren());
    }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;

private:
    std::vector<osg::ref_ptr<osg::Group>> _nodes;
};

const core::GeodeticBin kExtents = extentsDeg(10, 12, 20, 22);

/// What is asked of a mesh in a scene of a strange shape: seen from above with every method, and culled with bins where
/// the camera looks at it no more.
class WatchedMesh {
public:
    WatchedMesh() : mesh(makeMeshTile(kExtents, 100.0)) { _reached.watch(*mesh, "mesh"); }

    /// Returns: how many tiles have bins at last.
    std::size_t installOften(osg::Node& scene) {
        CullOptions options;
        for (const Method method : {Method::Quadratic, Method::None, Method::Sphere}) {
            options.method = method;
            (void)installBins(scene, options);
            EXPECT_TRUE(isReached(scene, 21.0)) << static_cast<int>(method);
        }
        options.method = Method::Quadratic;
        const std::size_t bins = installBins(scene, options);
        const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
        scene.accept(*update);
        EXPECT_TRUE(isReached(scene, 21.0));
        EXPECT_FALSE(isReached(scene, 60.0));
        return bins;
    }

    const osg::ref_ptr<osg::Node> mesh;

private:
    bool isReached(osg::Node& scene, double longitudeDeg) {
        return _reached.in(scene, ecefDeg(11, longitudeDeg, 1e5), ecefDeg(11, longitudeDeg, 0), 60.0).count("mesh") > 0;
    }

    ReachedTiles _reached;
};

// Above a tile, and below one.
TEST(HugeScenes, TransformsMayBeDeep) {
    WatchedMesh watched;
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(watched.mesh, "none.osgb");
    Chain chain([](int) { return new osg::MatrixTransform; }, tile);
    WatchedMesh below;
    Chain chainBelow([](int) { return new osg::MatrixTransform; }, below.mesh);
    const osg::ref_ptr<osg::PagedLOD> above = makePaged(makeMeshTile(kExtents, 100.0), "none.osgb");
    putBelow(*above, chainBelow.root->getChild(0));
    chain.root->addChild(above);
    EXPECT_EQ(watched.installOften(*chain.root), 3u);
    EXPECT_EQ(below.installOften(*chain.root), 3u);
    EXPECT_TRUE(installedOn(*tile) && installedOn(*above) && installedOn(*chainBelow.root->getChild(0)));
}

TEST(HugeScenes, TilesMayBeDeep) {
    Chain chain(
        [](int i) -> osg::ref_ptr<osg::Group> {
            return makePaged(makeMeshTile(kExtents, 100.0 + i), "tile" + std::to_string(i) + ".osgb");
        },
        makeMeshTile(kExtents, 100.0));
    const CapturedNotes notes;
    EXPECT_GT(installBins(*chain.root), 100u);
    EXPECT_EQ(notes.count("tiles nested hundreds deep"), 1u);
    for (const Method method : {Method::None, Method::Sphere, Method::Exact}) {
        CullOptions options;
        options.method = method;
        (void)installBins(*chain.root, options);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

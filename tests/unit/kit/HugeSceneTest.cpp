// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Scenes of a shape that no terrain has: very wide, very deep, sharing nodes, naming themselves. The kit's visitors end
// in a time that grows with the scene alone, and with the stack that OSG's own traversals need.

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/MatrixTransform>
#include <osgUtil/UpdateVisitor>

#include <functional>
#include <string>
#include <support/CapturedNotes.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kDeep = 1500;  // each call takes several times the stack
constexpr int kWide = 500;
constexpr int kGroups = 20000;
#else
constexpr int kDeep = 10000;
constexpr int kWide = 5000;
constexpr int kGroups = 200000;
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

    /// One like it, that is watched too.
    [[nodiscard]] osg::ref_ptr<osg::Node> another() const {
        return osg::clone(mesh.get(), osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_DRAWABLES);
    }

    /// Returns: how many drawables are left to draw where the camera looks at it.
    [[nodiscard]] static std::size_t drawnIn(osg::Node& scene) {
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        return cull(scene, CullView::lookAt(ecefDeg(11, 21, 1e5), ecefDeg(11, 21, 0), {0, 0, 1}, 60.0), *visitor)
            .drawn.size();
    }

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

// Hundreds of thousands of groups (fewer with the address sanitizer), and as many tiles as fit into some seconds. They
// share vertices and no nodes: OSG tells every parent of a node that its culling changes.
TEST(HugeScenes, MayBeVeryWide) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    WatchedMesh watched;
    const osg::ref_ptr<osg::Group> wide = new osg::Group;
    for (int i = 0; i < kGroups; ++i) wide->addChild(new osg::Group);
    for (int i = 0; i < kWide; ++i) wide->addChild(makePaged(watched.another(), "none.osgb"));
    const osg::ref_ptr<osg::PagedLOD> above = makePaged(watched.mesh, "none.osgb");
    putBelow(*above, wide);
    root->addChild(above);
    EXPECT_EQ(watched.installOften(*root), static_cast<std::size_t>(kWide) + 1);
    EXPECT_EQ(WatchedMesh::drawnIn(*root), static_cast<std::size_t>(kWide));  // in place of the coarser one
}

// Every node twice below the one above: as many paths as there are bits.
TEST(HugeScenes, PathsAreAsManyAsTheSceneHas) {
    WatchedMesh watched;
    osg::ref_ptr<osg::Node> node = watched.mesh;
    for (int i = 0; i < 12; ++i) {
        const osg::ref_ptr<osg::Group> above = i % 2 ? new osg::Group : new osg::MatrixTransform;
        above->addChild(node);
        above->addChild(node);
        node = above;
    }
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(makeMeshTile(kExtents, 100.0), "none.osgb");
    putBelow(*tile, node);
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->addChild(tile);
    // the tile, and what is below it: a transform that stands in two places
    EXPECT_EQ(watched.installOften(*root), 3u);
    EXPECT_TRUE(installedOn(*tile));
}

}  // namespace
}  // namespace osgAnalyticBin::test

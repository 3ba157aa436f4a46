// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Scenes of a shape that no terrain has: very wide, very deep, sharing nodes, naming themselves. The kit's visitors end
// in a time that grows with the scene alone, and with the stack that OSG's own traversals need.

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/BinInstaller.h>
#include <osgAnalyticBin/TileSurface.h>

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

void installTwice(osg::Node& scene) {
    CullOptions options;
    for (const Method method : {Method::Quadratic, Method::None, Method::Sphere}) {
        options.method = method;
        (void)installBins(scene, options);
    }
    options.method = Method::Quadratic;
    (void)installBins(scene, options);
    const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
    scene.accept(*update);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    (void)cull(scene, CullView::lookAt(ecefDeg(11, 21, 1e5), ecefDeg(11, 21, 0), {0, 0, 1}, 60.0), *visitor);
}

TEST(HugeScenes, GroupsMayBeDeep) {
    Chain chain([](int) { return new osg::Group; }, makeMeshTile(kExtents, 100.0));
    installTwice(*chain.root);
}

TEST(HugeScenes, TransformsMayBeDeep) {
    Chain chain([](int) { return new osg::MatrixTransform; }, makeMeshTile(kExtents, 100.0));
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeMeshTile(kExtents, 100.0), "none.osgb");
    putBelow(*paged, chain.root->getChild(0));
    chain.root->addChild(paged);
    installTwice(*chain.root);
}

TEST(HugeScenes, TilesMayBeDeep) {
    Chain chain(
        [](int i) -> osg::ref_ptr<osg::Group> {
            return makePaged(makeMeshTile(kExtents, 100.0 + i), "tile" + std::to_string(i) + ".osgb");
        },
        makeMeshTile(kExtents, 100.0));
    const CapturedNotes notes;
    EXPECT_GT(installBins(*chain.root), 100u);
    EXPECT_EQ(notes.count("tiles in tiles"), 1u);
    for (const Method method : {Method::None, Method::Sphere, Method::Exact}) {
        CullOptions options;
        options.method = method;
        (void)installBins(*chain.root, options);
    }
}

TEST(HugeScenes, MayBeAMillionWide) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    const osg::ref_ptr<osg::Node> shared = makeMeshTile(kExtents, 100.0);
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(shared, "none.osgb");
    const osg::ref_ptr<osg::Group> wide = new osg::Group;
    for (int i = 0; i < 1000000; ++i) wide->addChild(new osg::Group);
    putBelow(*tile, wide);
    root->addChild(tile);
    installTwice(*root);
}

// Every node twice below the one above: as many paths as there are bits.
TEST(HugeScenes, PathsAreAsManyAsTheSceneHas) {
    osg::ref_ptr<osg::Node> node = makeMeshTile(kExtents, 100.0);
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
    installTwice(*root);
}

}  // namespace
}  // namespace osgAnalyticBin::test

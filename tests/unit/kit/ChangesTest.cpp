// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The table "What the kit notices" of the guide, line by line. Oracle: a tile on the other side of the globe is drawn
// where something in front is not known to hide it, and only there.

#include "KitTest.h"

#include <osg/StateSet>

namespace osgAnalyticBin::test {
namespace {

// Of which nobody knows whether it always traverses.
struct Through : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override { traverse(node, nv); }
};

struct Change {
    std::string name;
    std::function<void()> make, undo;
};

// The tile in front, the nodes of its mesh, and the globe above.
std::vector<osg::Node*> nodesOf(MeshGlobe& globe) {
    std::vector<osg::Node*> nodes{globe.root};
    for (osg::Node* at = globe.tiles[19]; at; at = at->asGroup() ? at->asGroup()->getChild(0) : nullptr)
        nodes.push_back(at);
    return nodes;
}

std::vector<Change> changesOfNodes(MeshGlobe& globe) {
    std::vector<Change> changes;
    for (osg::Node* const node : nodesOf(globe)) {
        const std::string name = std::string(" of a ") + node->className();
        if (node != globe.root)
            changes.push_back({"mask" + name, [=] { node->setNodeMask(0); }, [=] { node->setNodeMask(~0u); }});
        const osg::ref_ptr<osg::NodeCallback> callback = new Through;
        changes.push_back(
            {"callback" + name, [=] { node->addCullCallback(callback); }, [=] { node->removeCullCallback(callback); }});
        changes.push_back({"state set" + name,
                           [=] { node->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON); },
                           [=] { node->setStateSet(nullptr); }});
        changes.push_back({"mode" + name,
                           [=] { node->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF); },
                           [=] { node->getStateSet()->removeMode(GL_DEPTH_TEST); }});
    }
    osg::PagedLOD& tile = *globe.tiles[19];
    auto& transform = dynamic_cast<osg::MatrixTransform&>(*tile.getChild(0));
    changes.push_back({"reference frame", [&] { transform.setReferenceFrame(osg::Transform::ABSOLUTE_RF); },
                       [&] { transform.setReferenceFrame(osg::Transform::RELATIVE_RF); }});
    const osg::LOD::RangeList ranges = tile.getRangeList();
    changes.push_back({"ranges", [&tile] { tile.setRange(0, 0.0f, 1.0f); },
                       [&tile, ranges] { tile.setRange(0, ranges[0].first, ranges[0].second); }});
    return changes;
}

TEST(Changes, OfNodesCountInTheSameFrame) {
    MeshGlobe globe;
    installBins(*globe.root);
    for (const Change& change : changesOfNodes(globe)) {
        EXPECT_FALSE(globe.drawsAntipode()) << change.name;
        change.make();
        EXPECT_TRUE(globe.drawsAntipode()) << change.name;
        change.undo();
    }
    EXPECT_FALSE(globe.drawsAntipode());
}

// Takes a corner of the tile's mesh away, and puts it back.
TEST(Changes, OfVerticesThatAreAnnouncedCountInTheSameFrameAndWhatIsWholeAgainAfterTheNextUpdate) {
    MeshGlobe globe;
    installBins(*globe.root);
    osg::Geometry& geometry = *drawableOf(*globe.tiles[19])->asGeometry();
    auto& vertices = dynamic_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    const osg::Vec3 corner = vertices[0];
    const auto moveCorner = [&](const osg::Vec3& place) {
        vertices[0] = place;
        vertices.dirty();
        geometry.dirtyBound();
    };
    EXPECT_FALSE(globe.drawsAntipode());
    moveCorner(vertices[40]);
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    moveCorner(corner);
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
}

TEST(Changes, OfVerticesWithoutAWordCountWhenBinsAreInstalledAgain) {
    FiledGlobe globe;
    auto& vertices = dynamic_cast<osg::Vec3Array&>(*drawableOf(*globe.group)->asGeometry()->getVertexArray());
    const auto highest = [&globe] { return installedOn(*globe.tile)->getBin().bin().altitude().upper; };
    vertices[40] += osg::Vec3(ecefDeg(20, 20, 1.0) / ecefDeg(20, 20, 1.0).length() * 12000.0);
    (void)globe.root->getBound();
    update(*globe.root);
    EXPECT_LT(highest(), 12000.0);
    installBins(*globe.root);
    EXPECT_GE(highest(), 12000.0);
}

// A tile, and its mesh.
TEST(Changes, ThatTakeNodesAwayCountInTheSameFrameUntilBinsAreInstalledAgain) {
    for (const int depth : {0, 3}) {
        MeshGlobe globe;
        installBins(*globe.root);
        osg::ref_ptr<osg::Node> taken = globe.tiles[19];
        for (int i = 0; i < depth; ++i) taken = taken->asGroup()->getChild(0);
        osg::Group& parent = *taken->getParent(0);
        EXPECT_FALSE(globe.drawsAntipode()) << depth;
        parent.removeChild(taken);
        EXPECT_TRUE(globe.drawsAntipode()) << depth;
        update(*globe.root);
        parent.addChild(taken);
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(globe.drawsAntipode()) << depth << i;
            update(*globe.root);
        }
        installBins(*globe.root);
        EXPECT_FALSE(globe.drawsAntipode()) << depth;
    }
}

TEST(Changes, OfDepthWithinMeshesCountWhenBinsAreInstalledAgain) {
    const auto ignoreDepth = [](osg::Node& node) {
        node.getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    };
    MeshGlobe globe;
    installBins(*globe.root);
    ignoreDepth(*drawableOf(*globe.tiles[15]));
    EXPECT_FALSE(globe.drawsAntipode());
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
    MeshGlobe other;
    installBins(*other.root);
    ignoreDepth(*other.tiles[15]);
    EXPECT_TRUE(other.drawsAntipode());
}

TEST(Changes, OfCullingBelowTilesCountWhenBinsAreInstalledAgain) {
    MeshGlobe globe;
    installBins(*globe.root);
    drawableOf(*globe.tiles[15])->setCullingActive(false);
    EXPECT_FALSE(globe.drawsAntipode());
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
}

TEST(Changes, OfRadiiCountWhenBinsAreInstalledAgain) {
    MeshGlobe globe;
    installBins(*globe.root);
    const auto radius = [&globe] { return installedOn(*globe.tiles[19])->ellipsoid().equatorialRadius(); };
    globe.root->setEllipsoidModel(new osg::EllipsoidModel(6378000.0, osg::WGS_84_RADIUS_POLAR));
    EXPECT_EQ(radius(), osg::WGS_84_RADIUS_EQUATOR);
    installBins(*globe.root);
    EXPECT_EQ(radius(), 6378000.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is delivered of kept tiles. Oracle: OSG's own traversal of the same scene, by a visitor of a derived class.

#include "DatabaseFixture.h"
#include "PagedFlight.h"
#include "PlanarMap.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Depth>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderBin>
#include <osgUtil/RenderLeaf>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <functional>
#include <support/Random.h>
#include <support/TemporaryFolder.h>
#include <tuple>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

// Kept tiles are entered by OSG.
struct OtherVisitor : osgUtil::CullVisitor {};

// A leaf: the drawable, its matrix, its depth, the states above it.
struct Leaf {
    const osg::Drawable* drawable;
    osg::Matrixd matrix;
    float depth;
    std::vector<const osg::StateSet*> states;

    bool operator==(const Leaf& other) const {
        return drawable == other.drawable && matrix == other.matrix && depth == other.depth && states == other.states;
    }
};

// In the order in which they were delivered.
std::vector<Leaf> leavesIn(osgUtil::RenderBin& bin) {
    std::vector<std::pair<unsigned int, Leaf>> found;
    const std::function<void(osgUtil::RenderBin&)> collect = [&](osgUtil::RenderBin& from) {
        for (const osgUtil::StateGraph* graph : from.getStateGraphList()) {
            std::vector<const osg::StateSet*> states;
            for (const auto* above = graph; above; above = above->_parent) states.push_back(above->getStateSet());
            for (const auto& leaf : graph->_leaves) {
                found.push_back(
                    {leaf->_traversalOrderNumber, {leaf->getDrawable(), *leaf->_modelview, leaf->_depth, states}});
            }
        }
        for (const auto& [number, child] : from.getRenderBinList()) collect(*child);
    };
    collect(bin);
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Leaf> leaves;
    for (auto& [order, leaf] : found) leaves.push_back(std::move(leaf));
    return leaves;
}

// Returns: the number of leaves.
std::size_t expectSameLeaves(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> plain = new osgUtil::CullVisitor;
    const osg::ref_ptr<osgUtil::CullVisitor> other = new OtherVisitor;
    const CullResult here = cull(scene, view, *plain), there = cull(scene, view, *other);
    const std::vector<Leaf> leaves = leavesIn(*here.stage);
    EXPECT_EQ(leaves.size(), leavesIn(*there.stage).size());
    EXPECT_TRUE(leaves == leavesIn(*there.stage));
    EXPECT_EQ(here.projection, there.projection);
    return leaves.size();
}

void forEach(osg::Node& scene, const std::function<void(osg::Node&)>& action) {
    struct All : osg::NodeVisitor {
        explicit All(const std::function<void(osg::Node&)>& visit)
            : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), action(visit) {
            setNodeMaskOverride(~0u);
        }
        void apply(osg::Node& node) override {
            nodes.emplace_back(&node);
            traverse(node);
        }
        const std::function<void(osg::Node&)>& action;
        std::vector<osg::ref_ptr<osg::Node>> nodes;
    } all(action);
    scene.accept(all);
    for (const auto& node : all.nodes) action(*node);
}

class MapEntry : public testing::TestWithParam<bool> {
protected:
    MapEntry() {
        map.isTerrain = GetParam();
        root = map.build(folder.path());
        std::string error;
        installBins(*root, *cullOptionsFromText("index=off", error));
        PagedFlight flight(*root);
        const osg::Vec3d middle = map.origin + osg::Vec3d(0.5, 0.5, 0.0) * map.size;
        EXPECT_TRUE(
            flight.load(CullView::lookAt(middle + osg::Vec3d(0.0, 0.0, 4000.0), middle, {0.0, 1.0, 0.0}, 150.0)));
    }

    CullView randomView() {
        const auto place = [&] {
            return map.origin + osg::Vec3d(random.uniform(0.2, 0.8), random.uniform(0.2, 0.8), 0.0) * map.size;
        };
        CullView view = CullView::lookAt(place() + osg::Vec3d(0.0, 0.0, random.logUniform(3000.0, 30000.0)), place(),
                                         {0.0, 0.1, 1.0}, random.uniform(10.0, 100.0));
        view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
        return view;
    }

    std::size_t expectSame(int views) {
        std::size_t leaves = 0;
        for (int i = 0; i < views; ++i) {
            CullView view = randomView();
            for (const auto mode : {osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR,
                                    osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES,
                                    osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES}) {
                view.computeNearFar = mode;
                leaves += expectSameLeaves(*root, view);
            }
        }
        return leaves;
    }

    TemporaryFolder folder;
    PlanarMap map;
    osg::ref_ptr<osg::Group> root;
    Random random{20261125};
};

TEST_P(MapEntry, DeliversWhatOsgDelivers) {
    EXPECT_GT(expectSame(100), 1000u);
}

TEST_P(MapEntry, DeliversStatesOfAllNodes) {
    forEach(*root, [](osg::Node& node) {
        node.getOrCreateStateSet()->setRenderBinDetails(static_cast<int>(node.className()[0]), "RenderBin");
    });
    EXPECT_GT(expectSame(30), 300u);
}

TEST_P(MapEntry, HeedsNodeMasks) {
    forEach(*root, [this](osg::Node& node) {
        if (!dynamic_cast<osg::CoordinateSystemNode*>(&node) && random.chance(0.1)) node.setNodeMask(0);
    });
    expectSame(30);
}

TEST_P(MapEntry, LeavesWhatTheApplicationChangesToOsg) {
    struct LeaveOut : osg::NodeCallback {
        void operator()(osg::Node*, osg::NodeVisitor*) override {}
    };
    forEach(*root, [this](osg::Node& node) {
        if (random.chance(0.05)) node.setCullingActive(!node.getCullingActive());
        auto* const transform = dynamic_cast<osg::MatrixTransform*>(&node);
        if (transform && random.chance(0.1)) transform->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        if (!node.asDrawable() && !node.getCullCallback() && random.chance(0.05)) node.setCullCallback(new LeaveOut);
        if (node.asGeode() && random.chance(0.2)) node.asGeode()->addDrawable(new osg::Geometry);
        if (transform && random.chance(0.1)) transform->preMult(osg::Matrix::rotate(0.3, 0.2, 1.0, 0.1));
    });
    expectSame(30);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MapEntry, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Terrain" : "Meshes"; });

// Transforms that turn: the tiles of osgTerrain on a globe.
TEST(TileEntry, DeliversWhatOsgDeliversOnAGlobe) {
    const TemporaryFolder folder;
    Random random(20261126);
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
    for (double south = -90.0; south < 90.0; south += 30.0) {
        for (double west = -180.0; west < 180.0; west += 30.0) {
            const core::GeodeticBin extents = extentsDeg(south, south + 30.0, west, west + 30.0);
            const osg::ref_ptr<osg::MatrixTransform> frame = new osg::MatrixTransform;
            const osg::Matrixd turn = osg::Matrixd::rotate(random.uniform(0.0, 3.0), osg::Vec3d(1.0, 2.0, 3.0));
            frame->setMatrix(turn);
            const osg::ref_ptr<osg::MatrixTransform> back = new osg::MatrixTransform(osg::Matrixd::inverse(turn));
            back->addChild(makeMeshTile(extents, 100.0));
            frame->addChild(back);
            globe->addChild(makePaged(random.chance(0.5) ? frame : makeMeshTile(extents, 100.0), "no.osgb"));
        }
    }
    EXPECT_GT(installBins(*globe, {}), 0u);
    std::size_t leaves = 0;
    for (int i = 0; i < 100; ++i) {
        const auto place = [&](double altitude) {
            return ecefDeg(random.uniform(-89.0, 89.0), random.uniform(-180.0, 180.0), altitude);
        };
        CullView view = CullView::lookAt(place(random.logUniform(1e4, 3e7)), place(0.0), {0.1, 0.2, 1.0}, 60.0);
        if (i % 2) view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
        leaves += expectSameLeaves(*globe, view);
    }
    EXPECT_GT(leaves, 300u);
}

}  // namespace
}  // namespace osgAnalyticBin::test

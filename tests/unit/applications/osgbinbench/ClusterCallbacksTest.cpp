// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Cluster culling callbacks made from the meshes of tiles. Oracle: the numbers worked out by hand for a tile on a ball.

#include "ClusterCallbacks.h"
#include "FileWatch.h"
#include "PlacedMesh.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgUtil/CullVisitor>

#include <cmath>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::bench {
namespace {

using core::Ellipsoid;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 1e6;

// Posts of a square tile, degrees and metres, as a skirt hangs from them: 0 for the surface.
std::vector<glm::dvec3> posts(const Ellipsoid& globe, double south, double west, double size, double height,
                              double skirt = 0.0) {
    std::vector<glm::dvec3> vertices;
    constexpr int kCells = 8;
    for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; j <= kCells; ++j) {
            const auto post = [&](double altitude) {
                return globe.toEcef(
                    {(south + size * i / kCells) * kPi / 180, (west + size * j / kCells) * kPi / 180, altitude});
            };
            vertices.push_back(post(height));
            const bool isEdge = i == 0 || i == kCells || j == 0 || j == kCells;
            if (isEdge && skirt > 0.0) vertices.push_back(post(height - skirt));
        }
    }
    return vertices;
}

TEST(ClusterOf, IsWhatIsFoundByHand) {
    // A strip of the equator of a ball from 5 to 15 degrees east, 200 m high: the farthest posts are 5 degrees around.
    const Ellipsoid ball(kRadius, kRadius);
    std::vector<glm::dvec3> strip;
    for (const double longitude : {5.0, 10.0, 15.0}) strip.push_back(ball.toEcef({0.0, longitude * kPi / 180, 200.0}));
    const auto cluster = clusterOf(strip, ball);
    ASSERT_TRUE(cluster);
    // 2 asin(87247.7 / 2e6) of the chord to a post 200 m up, and acos(1e6 / 1000200): 0.0872754 + 0.0199983
    constexpr double kAngle = 0.1072738;
    EXPECT_NEAR(cluster->deviation, -std::sin(kAngle), 1e-6);
    EXPECT_NEAR(cluster->radius, kRadius * std::tan(kAngle), 1.0);
    EXPECT_NEAR(cluster->normal.x, std::cos(10.0 * kPi / 180), 1e-12);
    EXPECT_NEAR(cluster->normal.y, std::sin(10.0 * kPi / 180), 1e-12);
    EXPECT_NEAR(glm::length(cluster->controlPoint), kRadius / std::cos(kAngle), 0.2);
    EXPECT_NEAR(glm::dot(cluster->controlPoint, cluster->normal), kRadius / std::cos(kAngle), 0.2);
}

TEST(ClusterOf, StandsOnTheMiddleOfTheExtentsWithTheGeocentricNormal) {
    const Ellipsoid earth(6378137.0, 6356752.3142);
    for (const double west : {-180.0, 10.0, 174.0}) {
        const auto cluster = clusterOf(posts(earth, 40.0, west, 10.0, 500.0), earth);
        ASSERT_TRUE(cluster);
        const glm::dvec3 middle = earth.toEcef({45.0 * kPi / 180, (west + 5.0) * kPi / 180, 0.0});
        EXPECT_LT(glm::distance(cluster->normal, glm::normalize(middle)), 1e-9) << west;
        EXPECT_LT(glm::distance(glm::normalize(cluster->controlPoint - middle), cluster->normal), 1e-6) << west;
    }
}

TEST(ClusterOf, DoesNotCountSkirts) {
    const Ellipsoid earth(6378137.0, 6356752.3142);
    for (const double south : {0.0, 40.0, 80.0}) {
        const auto bare = clusterOf(posts(earth, south, 20.0, 10.0, 500.0), earth);
        const auto skirted = clusterOf(posts(earth, south, 20.0, 10.0, 500.0, 9000.0), earth);
        ASSERT_TRUE(bare && skirted);
        EXPECT_NEAR(skirted->deviation, bare->deviation, 1e-9) << south;
        EXPECT_NEAR(skirted->radius, bare->radius, 1e-2) << south;
    }
    // a tile of which all is deep counts
    EXPECT_LT(clusterOf(posts(earth, 0.0, 20.0, 10.0, -9000.0), earth)->deviation,
              clusterOf(posts(earth, 0.0, 20.0, 10.0, -500.0), earth)->deviation);
}

TEST(ClusterOf, ThereIsNoneForTilesThatReachAround) {
    const Ellipsoid earth(6378137.0, 6356752.3142);
    EXPECT_TRUE(clusterOf(posts(earth, -45.0, 0.0, 90.0, 0.0), earth));
    EXPECT_FALSE(clusterOf(posts(earth, -90.0, 0.0, 180.0, 0.0), earth));
    EXPECT_FALSE(clusterOf(posts(earth, -75.0, 0.0, 150.0, 0.0), earth));
    EXPECT_FALSE(clusterOf({}, earth));
}

// A tile as databases have them: a mesh about an origin of its own, and a finer file or none.
osg::ref_ptr<osg::Node> tile(double south, double west, const std::string& finer) {
    const Ellipsoid earth(6378137.0, 6356752.3142);
    const osg::ref_ptr<osg::Node> placed = test::placedMesh(posts(earth, south, west, 5.0, 100.0), GL_TRIANGLES);
    if (finer.empty()) return placed;
    const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->addChild(placed, 1e6F, 1e10F);
    paged->setFileName(1, finer);
    paged->setRange(1, 0.0F, 1e6F);
    return paged;
}

osg::ref_ptr<osg::CoordinateSystemNode> globe() {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    return root;
}

const osg::ClusterCullingCallback* clusterOn(const osg::Node& node) {
    return dynamic_cast<const osg::ClusterCullingCallback*>(node.getCullCallback());
}

TEST(ClusterFiller, GivesEveryTileOfAFileItsOwn) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = globe();
    root->addChild(tile(0.0, 0.0, "a.osgb"));
    root->addChild(tile(0.0, 5.0, "b.osgb"));
    EXPECT_EQ(fillClusterCallbacks(*root, nullptr), 2U);
    const osg::ClusterCullingCallback* const first = clusterOn(*root->getChild(0));
    ASSERT_TRUE(first);
    const auto expected =
        clusterOf(posts(Ellipsoid(6378137.0, 6356752.3142), 0.0, 0.0, 5.0, 100.0), Ellipsoid(6378137.0, 6356752.3142));
    EXPECT_NEAR(first->getDeviation(), expected->deviation, 1e-5);
    EXPECT_NEAR(first->getRadius(), expected->radius, 10.0);
    EXPECT_NEAR(first->getControlPoint().x(), expected->controlPoint.x, 10.0);
    EXPECT_EQ(clusterOn(*root->getChild(0)->asGroup()->getChild(0)), nullptr) << "one test a tile";
    EXPECT_EQ(fillClusterCallbacks(*root, nullptr), 0U) << "it has them now";
    EXPECT_EQ(removeClusterCallbacks(*root), 2U);
}

TEST(ClusterFiller, LeavesFilesThatHaveTheirOwn) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = globe();
    root->addChild(tile(0.0, 0.0, "a.osgb"));
    root->addChild(tile(0.0, 5.0, "b.osgb"));
    root->getChild(1)->setCullCallback(new osg::ClusterCullingCallback);
    EXPECT_EQ(fillClusterCallbacks(*root, nullptr), 0U);
    EXPECT_EQ(root->getChild(0)->getCullCallback(), nullptr);
}

TEST(ClusterFiller, GivesLeavesOfAPageTheirsInTheirOwnFrame) {
    const osg::ref_ptr<osg::EllipsoidModel> earth = new osg::EllipsoidModel;
    const osg::ref_ptr<osg::Group> page = new osg::Group;
    page->addChild(tile(0.0, 0.0, {}));
    ASSERT_EQ(fillClusterCallbacks(*page, earth.get()), 1U);
    const osg::ClusterCullingCallback* const own = clusterOn(*page->getChild(0));
    ASSERT_TRUE(own);
    const osg::Matrixd& toEcef = page->getChild(0)->asTransform()->asMatrixTransform()->getMatrix();
    const osg::Vec3d controlPoint = osg::Vec3d(own->getControlPoint()) * toEcef;
    EXPECT_NEAR(std::atan2(controlPoint.y(), controlPoint.x()), 2.5 * kPi / 180, 1e-5);
    EXPECT_GT(controlPoint.length(), 6378137.0);
}

TEST(ClusterFiller, TakesNothingButTilesForATile) {
    const osg::ref_ptr<osg::Node> model = tile(0.0, 0.0, {});
    EXPECT_EQ(fillClusterCallbacks(*model, nullptr), 0U) << "a root file without a globe";
    const osg::ref_ptr<osg::CoordinateSystemNode> map = globe();
    map->setEllipsoidModel(nullptr);
    map->setCoordinateSystem("PROJCS[\"UTM\"]");
    map->addChild(tile(0.0, 0.0, "a.osgb"));
    EXPECT_EQ(fillClusterCallbacks(*map, nullptr), 0U) << "a map";
}

// Tiles that a cull traversal without frustum culling draws, from 2000 km above 0 N 0 E.
std::size_t drawn(osg::Node& scene) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const osg::ref_ptr<osgUtil::StateGraph> states = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    visitor->setStateGraph(states);
    visitor->setRenderStage(stage);
    visitor->setCullingMode(osg::CullSettings::CLUSTER_CULLING);
    visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    visitor->pushViewport(new osg::Viewport(0, 0, 100, 100));
    visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(60, 1, 1e3, 1e8)));
    visitor->pushModelViewMatrix(
        new osg::RefMatrix(osg::Matrixd::lookAt(osg::Vec3d(8.4e6, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1))),
        osg::Transform::ABSOLUTE_RF);
    scene.accept(*visitor);
    visitor->popModelViewMatrix();
    visitor->popProjectionMatrix();
    visitor->popViewport();
    std::size_t leaves = 0;
    for (const auto& [state, graph] : states->_children) leaves += graph->_leaves.size();
    return leaves + states->_leaves.size();
}

TEST(ClusterFiller, CullsTheFarSideOfAFileThatIsRead) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::CoordinateSystemNode> root = globe();
    for (const double west : {0.0, 20.0, 60.0, 90.0, 120.0, 175.0}) root->addChild(tile(0.0, west, "absent.osgb"));
    const std::string file = folder / "scene.osgt";
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    const auto drawnWith = [&](Clusters treatment) {
        watch->setTreatment(treatment, 0.0);
        return drawn(*osgDB::readRefNodeFile(file));
    };
    EXPECT_EQ(drawnWith(Clusters::Remove), 6U);
    EXPECT_EQ(drawnWith(Clusters::Keep), 6U);
    // the horizon is 41 degrees away
    EXPECT_EQ(drawnWith(Clusters::Fill), 2U);
    watch->uninstall();
}

}  // namespace
}  // namespace osgAnalyticBin::bench

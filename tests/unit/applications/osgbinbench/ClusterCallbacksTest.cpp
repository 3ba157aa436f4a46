// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Cluster culling callbacks made from the meshes of tiles, and what is done with files that are read. Oracle: the
// numbers worked out by hand for a tile on a ball.

#include "ClusterCallbacks.h"
#include "MethodScene.h"

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/NodeCallback>
#include <osgDB/Registry>

#include <DatabaseFixture.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

using core::Ellipsoid;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr unsigned int kPosts = 9;
const Ellipsoid kEarth(6378137.0, 6356752.3142);

// Posts of a square tile, degrees and metres, and below those of its edges, where `skirt` is not 0, those of a skirt.
std::vector<glm::dvec3> posts(double south, double west, double size, double height, double skirt = 0.0) {
    std::vector<glm::dvec3> vertices, hem;
    for (unsigned int i = 0; i < kPosts * kPosts; ++i) {
        const unsigned int row = i / kPosts, column = i % kPosts;
        const auto post = [&](double altitude) {
            return kEarth.toEcef({(south + size * row / (kPosts - 1)) * kDegree,
                                  (west + size * column / (kPosts - 1)) * kDegree, altitude});
        };
        vertices.push_back(post(height));
        const bool isEdge = row % (kPosts - 1) == 0 || column % (kPosts - 1) == 0;
        if (isEdge && skirt > 0.0) hem.push_back(post(height - skirt));
    }
    vertices.insert(vertices.end(), hem.begin(), hem.end());
    return vertices;
}

TEST(ClusterOf, IsWhatIsFoundByHand) {
    // A strip of the equator of a ball from 5 to 15 degrees east, 200 m high: the farthest posts are 5 degrees around.
    constexpr double kRadius = 1e6;
    const Ellipsoid ball(kRadius, kRadius);
    std::vector<glm::dvec3> strip;
    for (const double longitude : {5.0, 10.0, 15.0}) strip.push_back(ball.toEcef({0.0, longitude * kDegree, 200.0}));
    const auto cluster = clusterOf(strip, ball);
    ASSERT_TRUE(cluster);
    // 2 asin(87247.7 / 2e6) of the chord to a post 200 m up, and acos(1e6 / 1000200): 0.0872754 + 0.0199983
    constexpr double kAngle = 0.1072738;
    EXPECT_NEAR(cluster->deviation, -std::sin(kAngle), 1e-6);
    EXPECT_NEAR(cluster->radius, kRadius * std::tan(kAngle), 1.0);
    EXPECT_LT(glm::distance(cluster->normal, {std::cos(10.0 * kDegree), std::sin(10.0 * kDegree), 0.0}), 1e-12);
    EXPECT_LT(glm::distance(cluster->controlPoint, kRadius / std::cos(kAngle) * cluster->normal), 0.2);
}

TEST(ClusterOf, StandsOnTheMiddleOfTheExtentsAndDoesNotCountSkirts) {
    for (const auto& [south, west] : {std::pair(40.0, -180.0), {0.0, 10.0}, {40.0, 174.0}, {80.0, 20.0}}) {
        const auto bare = clusterOf(posts(south, west, 10.0, 500.0), kEarth);
        const auto skirted = clusterOf(posts(south, west, 10.0, 500.0, 9000.0), kEarth);
        ASSERT_TRUE(bare && skirted);
        EXPECT_NEAR(skirted->deviation, bare->deviation, 1e-9) << south;
        EXPECT_NEAR(skirted->radius, bare->radius, 1e-2) << south;
        const glm::dvec3 middle = kEarth.toEcef({(south + 5.0) * kDegree, (west + 5.0) * kDegree, 0.0});
        EXPECT_LT(glm::distance(bare->normal, glm::normalize(middle)), 1e-9) << west;
        EXPECT_LT(glm::distance(glm::normalize(bare->controlPoint - middle), bare->normal), 1e-6) << west;
    }
    // a tile of which all is deep counts
    EXPECT_LT(clusterOf(posts(0.0, 20.0, 10.0, -9000.0), kEarth)->deviation,
              clusterOf(posts(0.0, 20.0, 10.0, -500.0), kEarth)->deviation);
}

TEST(ClusterOf, ThereIsNoneForTilesThatReachAround) {
    EXPECT_TRUE(clusterOf(posts(-45.0, 0.0, 90.0, 0.0), kEarth));
    EXPECT_FALSE(clusterOf(posts(-90.0, 0.0, 180.0, 0.0), kEarth));
    EXPECT_FALSE(clusterOf(posts(-75.0, 0.0, 150.0, 0.0), kEarth));
    EXPECT_FALSE(clusterOf({}, kEarth));
}

// A tile as databases have them, 5 degrees wide: its mesh, and a finer file.
osg::ref_ptr<osg::MatrixTransform> leaf(double west) {
    return test::makeMeshTile(test::extentsDeg(0, 5, west, west + 5), 100.0, kPosts);
}
osg::ref_ptr<osg::Node> tile(double west) {
    return test::makePaged(leaf(west), "absent.osgb");
}

const osg::ClusterCullingCallback* clusterOn(const osg::Node& node) {
    return dynamic_cast<const osg::ClusterCullingCallback*>(node.getCullCallback());
}

TEST(ClusterFiller, GivesEveryTileOfAFileItsOwn) {
    const auto root = test::makeGlobe({tile(0.0), tile(5.0)});
    EXPECT_EQ(fillClusterCallbacks(*root, nullptr), 2U);
    const osg::ClusterCullingCallback* const first = clusterOn(*root->getChild(0));
    ASSERT_TRUE(first);
    const auto expected = clusterOf(posts(0.0, 0.0, 5.0, 100.0), kEarth);
    EXPECT_NEAR(first->getDeviation(), expected->deviation, 1e-5);
    EXPECT_NEAR(first->getRadius(), expected->radius, 10.0);
    EXPECT_NEAR(first->getControlPoint().x(), expected->controlPoint.x, 10.0);
    EXPECT_EQ(clusterOn(*root->getChild(0)->asGroup()->getChild(0)), nullptr) << "one test a tile";
    EXPECT_EQ(fillClusterCallbacks(*root, nullptr), 0U) << "it has them now";
    EXPECT_EQ(removeClusterCallbacks(*root), 2U);
}

TEST(ClusterFiller, GivesLeavesOfAPageTheirsInTheirOwnFrame) {
    const auto page = test::makeGroup({leaf(0.0)});
    ASSERT_EQ(fillClusterCallbacks(*page, osg::ref_ptr(new osg::EllipsoidModel).get()), 1U);
    const osg::ClusterCullingCallback* const own = clusterOn(*page->getChild(0));
    ASSERT_TRUE(own);
    const osg::Matrixd& toEcef = page->getChild(0)->asTransform()->asMatrixTransform()->getMatrix();
    const osg::Vec3d controlPoint = osg::Vec3d(own->getControlPoint()) * toEcef;
    EXPECT_NEAR(std::atan2(controlPoint.y(), controlPoint.x()), 2.5 * kDegree, 1e-5);
    EXPECT_GT(controlPoint.length(), 6378137.0);
}

TEST(ClusterFiller, LeavesFilesThatHaveTheirOwnAndWhatIsNoGlobe) {
    const auto own = test::makeGlobe({tile(0.0), tile(5.0)});
    own->getChild(1)->setCullCallback(new osg::ClusterCullingCallback);
    EXPECT_EQ(fillClusterCallbacks(*own, nullptr), 0U);
    EXPECT_EQ(own->getChild(0)->getCullCallback(), nullptr);
    EXPECT_EQ(fillClusterCallbacks(*leaf(0.0), nullptr), 0U) << "a root file without a globe";
    const auto map = test::makeGlobe({tile(0.0)});
    map->setEllipsoidModel(nullptr);
    map->setCoordinateSystem("PROJCS[\"UTM\"]");
    EXPECT_EQ(fillClusterCallbacks(*map, nullptr), 0U) << "a map";
}

osg::ref_ptr<osg::ClusterCullingCallback> cluster() {
    return new osg::ClusterCullingCallback(osg::Vec3(1, 0, 0), osg::Vec3(1, 0, 0), 0.5F);
}

TEST(RemoveClusterCallbacks, TakesThemOffNodesAndDrawablesAndLeavesOthers) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osgTerrain::TerrainTile> terrain = new osgTerrain::TerrainTile;
    const osg::ref_ptr<osg::NodeCallback> other = new osg::NodeCallback;
    root->addChild(test::placed(geometry, osg::Matrixd()));
    root->addChild(terrain);
    root->addCullCallback(other);
    root->addCullCallback(cluster());
    geometry->setCullCallback(cluster());
    terrain->setCullCallback(cluster());
    EXPECT_EQ(removeClusterCallbacks(*root), 3U);
    EXPECT_EQ(root->getCullCallback(), other);
    EXPECT_EQ(other->getNestedCallback(), nullptr);
    EXPECT_EQ(geometry->getCullCallback(), nullptr);
    // A traversal would have given it a technique.
    EXPECT_EQ(terrain->getTerrainTechnique(), nullptr);
    EXPECT_EQ(removeClusterCallbacks(*root), 0U);
}

TEST(FileWatch, TreatsWhatIsReadAsItIsTold) {
    const test::TemporaryFolder folder;
    const std::string file = folder / "scene.osgt";
    // Drawn from 2000 km above 0 N 0 E, where the horizon is 41 degrees away.
    const auto root = test::makeGlobe({tile(0.0), tile(20.0), tile(60.0), tile(90.0), tile(120.0), tile(175.0)});
    test::CullView view = test::CullView::lookAt({8.4e6, 0, 0}, {}, {0, 0, 1}, 60.0);
    view.cullingMode = osg::CullSettings::CLUSTER_CULLING;
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    const auto expectDrawn = [&](Clusters treatment, std::size_t tiles) {
        watch->setTreatment(treatment, 0.0);
        const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(file);
        EXPECT_EQ(test::cull(*scene, view, *osg::ref_ptr(new osgUtil::CullVisitor)).drawn.size(), tiles);
    };
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    expectDrawn(Clusters::Keep, 6U);
    expectDrawn(Clusters::Fill, 2U);
    EXPECT_EQ(watch->nodeFiles(), 2U);
    EXPECT_EQ(watch->nodeBytes(), 2 * std::filesystem::file_size(file));
    fillClusterCallbacks(*root, nullptr);
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    expectDrawn(Clusters::Keep, 2U);
    expectDrawn(Clusters::Remove, 6U);
    // times of what is paged are raised, and not that of the tile's own mesh
    watch->setTreatment(Clusters::Keep, 3.0);
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(file);
    const auto& lod = dynamic_cast<const osg::PagedLOD&>(*scene->asGroup()->getChild(0));
    EXPECT_EQ(lod.getMinimumExpiryTime(0), 0.0);
    EXPECT_EQ(lod.getMinimumExpiryTime(1), 3.0);
    watch->uninstall();
    EXPECT_NE(osgDB::Registry::instance()->getReadFileCallback(), watch.get());
}

}  // namespace
}  // namespace osgAnalyticBin::bench

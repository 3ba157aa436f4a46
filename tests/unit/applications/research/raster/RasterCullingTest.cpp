// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The peer that draws occluders into a small depth buffer. Oracles: every pixel's middle against every triangle in
// double precision; heights of the mesh that an occluder was made from; a ridge and what stands before and behind it.

#include "DepthRaster.h"
#include "PlacedMesh.h"
#include "RasterCulling.h"
#include "TileOccluder.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <osgUtil/CullVisitor>

#include <cmath>
#include <functional>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::bench {
namespace {

using core::Ellipsoid;
using core::Geodetic;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
const Ellipsoid kEarth(6378137.0, 6356752.3142);

// A rectangle in the picture, -1 to 1, at one distance.
std::array<ClipPoint, 8> plate(float left, float right, float bottom, float top, float w) {
    std::array<ClipPoint, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {w * ((i & 1U) != 0 ? right : left), w * ((i & 2U) != 0 ? top : bottom), w};
    return corners;
}

void drawPlate(DepthRaster& raster, float left, float right, float bottom, float top, float w) {
    const auto corners = plate(left, right, bottom, top, w);
    raster.draw(corners[0], corners[1], corners[3]);
    raster.draw(corners[0], corners[3], corners[2]);
}

TEST(DepthRaster, HidesWhatIsWhollyBehind) {
    DepthRaster raster(64, 40);
    raster.clear(1.0F);
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 200.0F))) << "nothing is drawn";
    drawPlate(raster, -0.5F, 0.5F, -0.5F, 0.5F, 100.0F);
    EXPECT_TRUE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 200.0F)));
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 99.0F))) << "in front";
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.6F, -0.2F, 0.2F, 200.0F))) << "it sticks out";
    EXPECT_FALSE(raster.hides(plate(1.5F, 1.7F, -0.2F, 0.2F, 200.0F))) << "beside the picture";
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 0.5F))) << "before the near plane";
    raster.clear(1.0F);
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 200.0F))) << "cleared";
}

TEST(DepthRaster, TrianglesThatFaceAwayHideNothing) {
    DepthRaster raster(64, 40);
    raster.clear(1.0F);
    drawPlate(raster, 0.5F, -0.5F, -0.5F, 0.5F, 100.0F);
    EXPECT_FALSE(raster.hides(plate(-0.2F, 0.2F, -0.2F, 0.2F, 200.0F)));
}

TEST(DepthRaster, CutsOffWhatIsNearerThanTheNearPlane) {
    // the ground below an eye 10 m up, from 50 m behind it to 1000 m ahead
    DepthRaster raster(64, 40);
    raster.clear(20.0F);
    const ClipPoint left{-500.0F, -10.0F, -50.0F}, right{500.0F, -10.0F, -50.0F};
    const ClipPoint farLeft{-500.0F, -10.0F, 1000.0F}, farRight{500.0F, -10.0F, 1000.0F};
    raster.draw(left, right, farRight);
    raster.draw(left, farRight, farLeft);
    EXPECT_TRUE(raster.hides(plate(-0.3F, 0.3F, -0.35F, -0.25F, 900.0F))) << "below the ground";
    EXPECT_FALSE(raster.hides(plate(-0.3F, 0.3F, -0.9F, -0.8F, 900.0F))) << "seen before the near plane";
    EXPECT_FALSE(raster.hides(plate(-0.3F, 0.3F, 0.1F, 0.2F, 900.0F))) << "above the horizon";
}

TEST(DepthRaster, AgreesWithEveryPixelTestedByItself) {
    test::Random random(20);
    int hidden = 0;
    for (int trial = 0; trial < 300; ++trial) {
        DepthRaster raster(40, 24);
        raster.clear(1.0F);
        std::vector<double> expected(40 * 24, 0.0);
        for (int t = 0; t < 12; ++t) {
            std::array<ClipPoint, 3> p;
            std::array<glm::dvec3, 3> s;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto w = static_cast<float>(random.logUniform(2.0, 100.0));
                p[i] = {w * static_cast<float>(random.uniform(-2.0, 2.0)),
                        w * static_cast<float>(random.uniform(-2.0, 2.0)), w};
                s[i] = {20.0 * (1.0 + p[i].x / static_cast<double>(w)), 12.0 * (1.0 + p[i].y / static_cast<double>(w)),
                        1.0 / w};
            }
            raster.draw(p[0], p[1], p[2]);
            const auto cross = [](const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
                return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            };
            const double area = cross(s[0], s[1], s[2].x, s[2].y);
            for (int i = 0; area > 0.0 && i < 40 * 24; ++i) {
                const double x = i % 40 + 0.5, y = i / 40 + 0.5;
                const double u = cross(s[1], s[2], x, y) / area, v = cross(s[2], s[0], x, y) / area;
                const double n = 1.0 - u - v;
                // what is at an edge may fall to either side
                if (u < -1e-4 || v < -1e-4 || n < -1e-4) continue;
                auto& pixel = expected[static_cast<std::size_t>(i)];
                pixel = std::max(pixel, u * s[0].z + v * s[1].z + n * s[2].z);
            }
        }
        for (int box = 0; box < 20; ++box) {
            const double x = random.uniform(0.0, 38.0), y = random.uniform(0.0, 22.0);
            const double right = std::min(39.9, x + random.uniform(0.0, 6.0));
            const double top = std::min(23.9, y + random.uniform(0.0, 6.0));
            const auto w = static_cast<float>(random.logUniform(2.0, 200.0));
            const auto across = [](double pixels, double size) {
                return static_cast<float>(2.0 * pixels / size - 1.0);
            };
            if (!raster.hides(plate(across(x, 40), across(right, 40), across(y, 24), across(top, 24), w))) continue;
            ++hidden;
            for (int j = static_cast<int>(y + 1e-3); j <= static_cast<int>(top - 1e-3); ++j)
                for (int i = static_cast<int>(x + 1e-3); i <= static_cast<int>(right - 1e-3); ++i)
                    EXPECT_GT(expected[static_cast<std::size_t>(j * 40 + i)], 0.999 / w) << trial;
        }
    }
    EXPECT_GT(hidden, 1000);
}

using Heights = std::function<double(double northShare, double eastShare)>;

// The posts of a tile of 0.1 degrees; optionally with skirts.
std::vector<glm::dvec3> posts(double south, double west, const Heights& heights, bool hasSkirts) {
    constexpr int kPosts = 32;
    std::vector<glm::dvec3> vertices;
    for (int j = 0; j <= kPosts; ++j) {
        for (int i = 0; i <= kPosts; ++i) {
            const double north = static_cast<double>(j) / kPosts, east = static_cast<double>(i) / kPosts;
            const auto post = [&](double depth) {
                return kEarth.toEcef(
                    {(south + 0.1 * north) * kDegree, (west + 0.1 * east) * kDegree, heights(north, east) - depth});
            };
            vertices.push_back(post(0.0));
            if (hasSkirts && (i % kPosts == 0 || j % kPosts == 0)) vertices.push_back(post(800.0));
        }
    }
    return vertices;
}

TEST(TileOccluder, IsNowhereAboveTheMesh) {
    test::Random random(3);
    std::vector<double> table(33 * 33);
    for (double& height : table) height = random.uniform(0.0, 2000.0);
    const Heights heights = [&](double north, double east) {
        return table[static_cast<std::size_t>(std::lround(32 * north) * 33 + std::lround(32 * east))];
    };
    const auto surface = surfaceOf(posts(46.0, 10.0, heights, true), kEarth);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->vertices.size(), 33U * 33U);
    for (const int cells : {4, 8, 16}) {
        const auto grid = occluderOf(surface->vertices, surface->middle, kEarth, cells);
        ASSERT_TRUE(grid);
        const auto row = static_cast<std::size_t>(cells) + 1;
        ASSERT_EQ(grid->nodes.size(), row * row);
        const auto posts = static_cast<std::size_t>(32 / cells);
        for (std::size_t j = 0; j < row; ++j) {
            for (std::size_t i = 0; i < row; ++i) {
                const double node = kEarth.toGeodetic(grid->origin + glm::dvec3(grid->nodes[j * row + i])).altitude;
                double least = 1e9;
                // all cells around the node
                for (std::size_t v = j > 0 ? (j - 1) * posts : 0; v <= std::min<std::size_t>(32, (j + 1) * posts); ++v)
                    for (std::size_t u = i > 0 ? (i - 1) * posts : 0; u <= std::min<std::size_t>(32, (i + 1) * posts);
                         ++u)
                        least = std::min(least, table[v * 33 + u]);
                EXPECT_NEAR(node, least, 0.01) << cells;
            }
        }
    }
}

TEST(TileOccluder, ThereIsNoneWhereVerticesAreTooSparse) {
    const auto corners = surfaceOf(
        {kEarth.toEcef({0.8, 0.1, 0.0}), kEarth.toEcef({0.8, 0.11, 0.0}), kEarth.toEcef({0.81, 0.1, 0.0})}, kEarth);
    ASSERT_TRUE(corners);
    EXPECT_FALSE(occluderOf(corners->vertices, corners->middle, kEarth, 4));
    EXPECT_FALSE(occluderOf({}, {}, kEarth, 4));
}

TEST(TileOccluder, TheBoxHoldsTheBin) {
    test::Random random(5);
    const core::GeodeticBin bin = core::GeodeticBin::fromDegrees({40.0, 42.0}, {100.0, 103.0}, {-200.0, 3000.0});
    const auto corners = boxCorners(AnalyticBin(bin, 2.0), kEarth);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 point =
            kEarth.toEcef({random.uniform(40.0, 42.0) * kDegree, random.uniform(100.0, 103.0) * kDegree,
                           random.uniform(-200.0, 3000.0)});
        for (const std::size_t axis : {1U, 2U, 4U}) {
            const glm::dvec3 edge = corners[axis] - corners[0];
            const double share = glm::dot(point - corners[0], edge) / glm::dot(edge, edge);
            EXPECT_GE(share, 0.0);
            EXPECT_LE(share, 1.0);
        }
    }
}

// A tile of 0.1 degrees with its bin.
osg::ref_ptr<osg::Node> tile(double south, double west, double low, double high) {
    const Heights ridge = [&](double north, double) {
        return low + (high - low) * (1.0 - std::abs(2.0 * north - 1.0));
    };
    const osg::ref_ptr<osg::Node> placed = test::placedMesh(posts(south, west, ridge, true), GL_POINTS);
    setStoredBin(
        *placed,
        AnalyticBin(core::GeodeticBin::fromDegrees({south, south + 0.1}, {west, west + 0.1}, {low, high}), 1.0));
    return placed;
}

std::size_t drawnFrom(osg::Node& scene, double latitude, double longitude, double altitude) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const osg::ref_ptr<osgUtil::StateGraph> states = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    visitor->setStateGraph(states);
    visitor->setRenderStage(stage);
    visitor->setTraversalNumber(1);
    visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    const auto at = [](const glm::dvec3& v) { return osg::Vec3d(v.x, v.y, v.z); };
    const Geodetic eye{latitude * kDegree, longitude * kDegree, altitude};
    const glm::dvec3 eyeEcef = kEarth.toEcef(eye);
    const osg::Vec3d ahead = at(kEarth.toEcef({eye.latitude + 0.01 * kDegree, eye.longitude, altitude}));
    visitor->pushViewport(new osg::Viewport(0, 0, 1280, 720));
    visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(60, 16.0 / 9, 1, 1e6)));
    visitor->pushModelViewMatrix(
        new osg::RefMatrix(osg::Matrixd::lookAt(at(eyeEcef), ahead, at(kEarth.up(eye.latitude, eye.longitude)))),
        osg::Transform::ABSOLUTE_RF);
    scene.accept(*visitor);
    visitor->popModelViewMatrix();
    visitor->popProjectionMatrix();
    visitor->popViewport();
    std::size_t leaves = 0;
    for (const auto& [state, graph] : states->_children) leaves += graph->_leaves.size();
    return leaves + states->_leaves.size();
}

TEST(RasterCulling, ARidgeHidesWhatIsBehindItAndNothingElse) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    root->addChild(tile(46.3, 10.0, 0.0, 300.0));   // low ground far away
    root->addChild(tile(46.1, 10.0, 0.0, 3000.0));  // the ridge
    root->addChild(tile(46.0, 10.0, 0.0, 100.0));   // before it
    EXPECT_EQ(drawnFrom(*root, 45.95, 10.05, 500.0), 3U);
    EXPECT_EQ(prepareRasterTiles(*root, nullptr), 3U);
    EXPECT_EQ(prepareRasterTiles(*root, nullptr), 0U) << "once";
    EXPECT_EQ(drawnFrom(*root, 45.95, 10.05, 500.0), 3U) << "nothing walks yet";
    installRaster(*root, 1280, 720);
    EXPECT_EQ(drawnFrom(*root, 45.95, 10.05, 500.0), 2U);
    EXPECT_EQ(drawnFrom(*root, 45.95, 10.05, 9000.0), 3U) << "from above the ridge";
}

}  // namespace
}  // namespace osgAnalyticBin::bench

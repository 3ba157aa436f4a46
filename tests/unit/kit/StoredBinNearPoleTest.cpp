// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Coarse meshes beside a pole, whose stored bins are right: the bound of such a mesh that the check has is rough in
// latitude, which is no reason to call the bin too small. Oracle of the bins: core::GeodeticMeshBounds. False bins
// elsewhere are in FalseBinTest.cpp; the tiles that this was found with in applications/osgbinglobe.

#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <array>
#include <support/CapturedNotes.h>

namespace osgAnalyticBin::test {
namespace {

const std::string kTooSmall = "larger than the bin stored with it or above it";
constexpr int kCoarsePosts = 3;
constexpr double kMarginAngle = 0.01 / 6.4e6;  // metres, as an angle

struct CoarseTile {
    osg::ref_ptr<osg::Group> node;
    core::GeodeticBin bin;
};

CoarseTile makeCoarseTile(const core::GeodeticBin& extents) {
    std::array<osg::Vec3d, kCoarsePosts * kCoarsePosts> posts;
    const core::Ellipsoid wgs84(6378137.0, 6356752.314245);
    for (int j = 0; j < kCoarsePosts; ++j) {
        for (int i = 0; i < kCoarsePosts; ++i) {
            const double v = j / (kCoarsePosts - 1.0);
            const double u = i / (kCoarsePosts - 1.0);
            const glm::dvec3 ecef = wgs84.toEcef({extents.latitude().lower + v * extents.latitude().width(),
                                                  extents.longitude().lower + u * extents.longitude().width(), 0.0});
            posts[static_cast<std::size_t>(j * kCoarsePosts + i)] = {ecef.x, ecef.y, ecef.z};
        }
    }
    const osg::Vec3d center = posts[posts.size() / 2];
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    core::GeodeticMeshBounds bounds(wgs84, extents.center().longitude);
    std::array<glm::dvec3, kCoarsePosts * kCoarsePosts> drawn;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        vertices->push_back(osg::Vec3(posts[i] - center));
        const osg::Vec3d point = osg::Vec3d(vertices->back()) + center;
        drawn[i] = {point.x(), point.y(), point.z()};
        bounds.expandByVertex(drawn[i]);
    }
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (unsigned int j = 0; j + 1 < kCoarsePosts; ++j) {
        for (unsigned int i = 0; i + 1 < kCoarsePosts; ++i) {
            const unsigned int a = j * kCoarsePosts + i;
            for (const std::array<unsigned int, 3>& corners :
                 {std::array{a, a + 1U, a + kCoarsePosts + 1U},
                  std::array{a, a + kCoarsePosts + 1U, a + kCoarsePosts}}) {
                bounds.expandByTriangle(drawn[corners[0]], drawn[corners[1]], drawn[corners[2]]);
                for (const unsigned int corner : corners) triangles->push_back(static_cast<GLushort>(corner));
            }
        }
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(triangles);
    const osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(osg::Matrix::translate(center));
    placed->addChild(geometry);
    CoarseTile tile{new osg::Group, bounds.bin()};
    tile.node->addChild(placed);
    return tile;
}

// A square of so many degrees; its nearer edge so many rows of such tiles from the pole.
core::GeodeticBin besidePole(bool isNorth, double width, int rows) {
    const double near = 90.0 - width * rows;
    return isNorth ? extentsDeg(near - width, near, 10.0, 10.0 + width)
                   : extentsDeg(-near, -near + width, 10.0, 10.0 + width);
}

// What is culled by after the bin has been stored and compared with the mesh.
AnalyticBin installedWith(const CoarseTile& tile, const AnalyticBin& stored) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    setStoredBin(*tile.node, stored);
    root->addChild(tile.node);
    EXPECT_EQ(installBins(*root), 1U);
    return installedOn(*tile.node)->getBin();
}

TEST(StoredBinNearPole, ThatIsRightIsNoFalseAlarm) {
    const CapturedNotes notes;
    for (const bool isNorth : {false, true}) {
        for (const double width : {11.25, 5.625, 2.8125, 1.40625, 0.3515625}) {
            for (const int rows : {1, 2, 3}) {
                const CoarseTile tile = makeCoarseTile(besidePole(isNorth, width, rows));
                const AnalyticBin stored = AnalyticBin::fromText(AnalyticBin(tile.bin, 0.01).toText());
                EXPECT_EQ(installedWith(tile, stored), stored) << isNorth << ' ' << width << ' ' << rows;
            }
        }
    }
    EXPECT_EQ(notes.count(kTooSmall), 0U);
}

TEST(StoredBinNearPole, ThatEndsTooEarlyIsWidened) {
    for (const bool isNorth : {false, true}) {
        for (const double width : {5.625, 1.40625, 0.3515625}) {
            for (const int rows : {1, 2, 3}) {
                const CoarseTile tile = makeCoarseTile(besidePole(isNorth, width, rows));
                const core::Interval& latitude = tile.bin.latitude();
                const double quarter = 0.25 * latitude.width();
                for (const core::Interval& range : {core::Interval{latitude.lower + quarter, latitude.upper},
                                                    core::Interval{latitude.lower, latitude.upper - quarter}}) {
                    const CapturedNotes notes;
                    const AnalyticBin stored(core::GeodeticBin(range, tile.bin.longitude(), tile.bin.altitude()), 0.01);
                    const core::Interval widened = installedWith(tile, stored).bin().latitude();
                    EXPECT_LE(widened.lower - latitude.lower, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_LE(latitude.upper - widened.upper, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_EQ(notes.count(kTooSmall), 1U) << isNorth << ' ' << width << ' ' << rows;
                }
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

//
// Slabs as they are drawn. Oracle: the mapping's inverse, point by point.

#include "Slab.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>

#include <cmath>

namespace osgAnalyticBin::viewer {
namespace {

const core::Ellipsoid kEarth(6378137.0, 6356752.3142);
constexpr double kSag = 500.0;

core::GeodeticBin binDeg(core::Interval latitude, core::Interval longitude, core::Interval altitude) {
    return core::GeodeticBin::fromDegrees(latitude, longitude, altitude);
}

const core::GeodeticBin kBins[] = {binDeg({10, 11}, {20, 21}, {-500, 4000}),
                                   binDeg({-45, 0}, {90, 135}, {-12000, 3000}),
                                   binDeg({67.5, 90}, {-180, -157.5}, {0, 10}), binDeg({30, 50}, {170, 200}, {0, 9000}),
                                   binDeg({-90, 90}, {-180, 180}, {-100, 100})};

class Slab : public ::testing::TestWithParam<core::GeodeticBin> {};

TEST_P(Slab, HasItsVerticesOnTheBinsSurface) {
    const core::GeodeticBin& bin = GetParam();
    const SlabMesh mesh = slabMesh(bin, kEarth, SlabShape::Bin);
    const osg::EllipsoidModel ellipsoid(kEarth.equatorialRadius(), kEarth.polarRadius());
    for (const osg::Vec3& vertex : mesh.vertices) {
        const osg::Vec3d ecef = osg::Vec3d(vertex) + mesh.origin;
        core::Geodetic at{};
        ellipsoid.convertXYZToLatLongHeight(ecef.x(), ecef.y(), ecef.z(), at.latitude, at.longitude, at.altitude);
        const double metre = 1.0 / kEarth.polarRadius();
        const core::Interval lat = bin.latitude();
        ASSERT_TRUE(lat.lower - metre < at.latitude && at.latitude < lat.upper + metre);
        // OSG divides by the cosine of the latitude
        if (std::hypot(ecef.x(), ecef.y()) < 1e4) at.altitude = std::abs(ecef.z()) - kEarth.polarRadius();
        ASSERT_TRUE(bin.altitude().lower - 10.0 < at.altitude && at.altitude < bin.altitude().upper + 10.0)
            << at.altitude;
    }
}

TEST_P(Slab, HoldsTheBinButForTheSagOfItsChords) {
    const core::GeodeticBin& bin = GetParam();
    const SlabMesh mesh = slabMesh(bin, kEarth, SlabShape::Bin);
    const core::ExactGeodeticBin exact(kEarth, bin);
    for (int i = 0; i < 200; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / 200.0;
        const double angle = 2.4 * i;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(r * std::cos(angle), r * std::sin(angle), z);
        double farthest = -1e9;
        for (const osg::Vec3& vertex : mesh.vertices) {
            const osg::Vec3d ecef = osg::Vec3d(vertex) + mesh.origin;
            farthest = std::max(farthest, ecef.x() * direction.x + ecef.y() * direction.y + ecef.z() * direction.z);
        }
        EXPECT_LE(farthest, exact.support(direction) + 2.0);
        EXPECT_GE(farthest, exact.support(direction) - kSag);
    }
}

TEST_P(Slab, HasTwelveEdgesAndClosedFaces) {
    const SlabMesh mesh = slabMesh(GetParam(), kEarth, SlabShape::Bin);
    EXPECT_EQ(mesh.triangles.size() % 3, 0u);
    EXPECT_EQ(mesh.lines.size() % 2, 0u);
    EXPECT_GE(mesh.lines.size(), 24u);
    for (const unsigned int index : mesh.triangles) ASSERT_LT(index, mesh.vertices.size());
    for (const unsigned int index : mesh.lines) ASSERT_LT(index, mesh.vertices.size());
}

bool holds(const core::GeodeticBin& bin, const osg::Vec3d& ecef) {
    const osg::EllipsoidModel ellipsoid(kEarth.equatorialRadius(), kEarth.polarRadius());
    core::Geodetic at{};
    ellipsoid.convertXYZToLatLongHeight(ecef.x(), ecef.y(), ecef.z(), at.latitude, at.longitude, at.altitude);
    return bin.contains(at);
}

// Bins that are thicker than the step, and have no pole, where triangles may have no area.
TEST(SlabFaces, AreCounterclockwiseFromOutside) {
    constexpr double kStep = 2000.0;
    for (const core::GeodeticBin& bin :
         {binDeg({10, 11}, {20, 21}, {-500, 4000}), binDeg({-45, 0}, {90, 135}, {-12000, 3000}),
          binDeg({30, 50}, {170, 200}, {0, 9000})}) {
        const SlabMesh mesh = slabMesh(bin, kEarth, SlabShape::Bin);
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            const osg::Vec3d a = mesh.vertices[mesh.triangles[i]];
            const osg::Vec3d b = mesh.vertices[mesh.triangles[i + 1]];
            const osg::Vec3d c = mesh.vertices[mesh.triangles[i + 2]];
            osg::Vec3d step = (b - a) ^ (c - a);
            step *= kStep / step.length();
            const osg::Vec3d middle = mesh.origin + (a + b + c) / 3.0;
            ASSERT_FALSE(holds(bin, middle + step)) << i;
            ASSERT_TRUE(holds(bin, middle - step)) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Slab, ::testing::ValuesIn(kBins));

TEST(QuadraticSlab, LeavesTheBinByNoMoreThanTheRemainder) {
    const core::GeodeticBin bin = binDeg({30, 40}, {100, 112}, {-500, 9000});
    const SlabMesh exact = slabMesh(bin, kEarth, SlabShape::Bin);
    const SlabMesh model = slabMesh(bin, kEarth, SlabShape::Quadratic);
    const core::QuadraticBin quadratic(core::GeodeticMapping(kEarth), core::parameterBox(bin));
    ASSERT_EQ(exact.vertices.size(), model.vertices.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < exact.vertices.size(); ++i) {
        largest = std::max(
            largest,
            ((osg::Vec3d(exact.vertices[i]) + exact.origin) - (osg::Vec3d(model.vertices[i]) + model.origin)).length());
    }
    EXPECT_LE(largest, quadratic.remainder() + 2.0);
    EXPECT_GT(largest, 0.1 * quadratic.remainder());
}

}  // namespace
}  // namespace osgAnalyticBin::viewer

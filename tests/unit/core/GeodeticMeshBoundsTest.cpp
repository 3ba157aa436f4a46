// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: points of the triangles, taken back to latitude, longitude and altitude in long double.

#include "CoreTest.h"
#include "MeshSamples.h"

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticMeshBounds;

constexpr double kMeshPromised = 1e-7;  // metres, by GeodeticMeshBounds

TEST(GeodeticMeshBounds, IsEmptyBeforeTheFirstVertex) {
    EXPECT_TRUE(GeodeticMeshBounds(wgs84(), 0.0).bin().empty());
}

TEST(GeodeticMeshBounds, OneVertexIsAPoint) {
    const Geodetic position{0.4, 3.0, 1234.0};
    GeodeticMeshBounds bounds(wgs84(), 3.1);
    bounds.expandByVertex(wgs84().toEcef(position));
    const GeodeticBin bin = bounds.bin();
    EXPECT_NEAR(bin.latitude().lower, position.latitude, 1e-14);
    EXPECT_NEAR(bin.longitude().lower, position.longitude, 1e-14);
    EXPECT_NEAR(bin.altitude().lower, position.altitude, kMeshPromised);
    EXPECT_EQ(bin.latitude().width() + bin.longitude().width() + bin.altitude().width(), 0.0);
}

TEST(GeodeticMeshBounds, HoldsMeshesAcrossTheDateLine) {
    Random random(92);
    for (int trial = 0; trial < 500; ++trial) {
        const double west = kPi - random.uniform(0.0, 0.4);
        const double south = random.uniform(-1.4, 1.2);
        const GeodeticBin bin({south, south + 0.2}, {west, west + 0.4}, {-500.0, 9000.0});
        const EcefMesh mesh = gridMesh(random, wgs84(), bin, 3);
        for (const double reference : {west + 0.2, west + 0.2 - 2.0 * kPi}) {
            const GeodeticBin found = thoroughBounds(wgs84(), mesh, reference, 0.0);
            ASSERT_LT(found.longitude().width(), 0.4 + 1e-9) << "not the long way round";
            expectHolds(random, wgs84(), mesh, found, kMeshPromised);
        }
    }
}

// The northern row of a polar tile is one point, each of its copies with a rounding error for a longitude.
TEST(GeodeticMeshBounds, PoleRowsHaveNoLongitude) {
    constexpr double kAxisTolerance = 1e-3;
    Random random(93);
    for (int trial = 0; trial < 500; ++trial) {
        const double side = random.sign();
        const double width = random.uniform(0.01, 0.4);
        const double west = random.uniform(-kPi, kPi);
        const Interval latitude =
            side > 0.0 ? Interval{kHalfPi - width, kHalfPi} : Interval{-kHalfPi, -kHalfPi + width};
        const GeodeticBin bin(latitude, {west, west + width}, {-500.0, 9000.0});
        EcefMesh mesh = gridMesh(random, wgs84(), bin, 3);
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            if (std::hypot(mesh.x[i], mesh.y[i]) >= 1e-3) continue;
            mesh.x[i] = random.uniform(-1e-9, 1e-9);
            mesh.y[i] = random.uniform(-1e-9, 1e-9);
        }
        const GeodeticBin found = thoroughBounds(wgs84(), mesh, west + 0.5 * width, kAxisTolerance);
        ASSERT_LT(found.longitude().width(), width + 1e-9);
        expectHolds(random, wgs84(), mesh, found, kMeshPromised + kAxisTolerance);
    }
}

TEST(GeodeticMeshBounds, TrianglesOverThePoleCoverTheCircle) {
    Random random(94);
    for (int trial = 0; trial < 2000; ++trial) {
        EcefMesh mesh;
        const double start = random.uniform(-kPi, kPi);
        const double side = random.sign();
        for (int i = 0; i < 3; ++i) {
            addVertex(mesh,
                      wgs84().toEcef({side * (kHalfPi - random.uniform(0.01, 0.3)),
                                      start + i * 2.1 + random.uniform(-0.4, 0.4), random.uniform(-500.0, 9000.0)}));
        }
        mesh.triangles = {0, 1, 2};
        const GeodeticBin bin = thoroughBounds(wgs84(), mesh, start, 0.0);
        ASSERT_TRUE(bin.isFullCircle());
        ASSERT_TRUE(bin.contains(Geodetic{side * kHalfPi, 0.0, bin.altitude().middle()}));
        expectHolds(random, wgs84(), mesh, bin, kMeshPromised);
    }
}

// A closed globe: one column of posts serves both sides of the date line, so some triangles run from +180 - step
// to -180 + step, or from 180 to -180 + step.
TEST(GeodeticMeshBounds, ClosedGlobesCoverTheCircle) {
    Random random(95);
    for (int trial = 0; trial < 40; ++trial) {
        const auto columns = static_cast<std::uint32_t>(random.integer(4, 24));
        const double first = -kPi + (random.chance(0.5) ? 0.0 : random.uniform(0.0, 1.0));
        const GeodeticBin extents({-1.5, 1.5}, {first, first + 2.0 * kPi * (columns - 1) / columns}, {0.0, 9000.0});
        EcefMesh closed = gridMesh(random, wgs84(), extents, columns - 1);
        for (std::uint32_t row = 0; row + 1 < columns; ++row) {
            const std::uint32_t west = row * columns, east = west + columns - 1;
            for (const std::uint32_t corner : {east, west, east + columns, east + columns, west, west + columns})
                closed.triangles.push_back(corner);
        }
        expectHolds(random, wgs84(), closed, thoroughBounds(wgs84(), closed, 0.0, 0.0), kMeshPromised);
    }
}

// The shared column stands at y = 0 exactly, where the two longitudes +-180 degrees are one point; the sign of the zero
// decides which of them it is given.
TEST(GeodeticMeshBounds, ColumnsOnTheAntimeridianServeBothSides) {
    const Ellipsoid earth = wgs84();
    Random random(97);
    for (const double zero : {0.0, -0.0}) {
        const auto at = [&](double latitude, double longitudeDeg) {
            const glm::dvec3 point = earth.toEcef({latitude, longitudeDeg * kRadiansPerDegree, 0.0});
            return std::abs(longitudeDeg) == 180.0 ? glm::dvec3(point.x, zero, point.z) : point;
        };
        EcefMesh mesh;
        for (const double west : {-180.0, -120.0, -60.0, 0.0, 60.0, 120.0}) {
            const auto first = static_cast<std::uint32_t>(mesh.size());
            for (const double latitude : {-0.5, 0.5}) {
                addVertex(mesh, at(latitude, west));
                addVertex(mesh, at(latitude, west + 60.0));
            }
            for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U}) mesh.triangles.push_back(first + corner);
        }
        expectHolds(random, earth, mesh, thoroughBounds(earth, mesh, 0.0, 0.0), kMeshPromised);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

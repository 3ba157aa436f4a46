// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: points of the triangles, taken back to latitude, longitude and altitude in long double.

#include "TriangleSamples.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <support/RandomBins.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;
using core::GeodeticMeshBounds;
using core::Interval;

constexpr double kMeshPromised = 1e-7;  // metres, by GeodeticMeshBounds

struct Mesh {
    std::vector<glm::dvec3> vertices;
    std::vector<Triangle> triangles;
};

// Posts on a grid over the bin, each with its own altitude, joined as terrain tiles are.
Mesh gridMesh(Random& random, const Ellipsoid& ellipsoid, const GeodeticBin& bin, int rows, int columns) {
    Mesh mesh;
    const auto at = [](const Interval& interval, int i, int n) {
        return i == n ? interval.upper : interval.lower + interval.width() * i / n;
    };
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            mesh.vertices.push_back(
                ellipsoid.toEcef({at(bin.latitude(), row, rows), at(bin.longitude(), column, columns),
                                  random.uniform(bin.altitude().lower, bin.altitude().upper)}));
        }
    }
    const auto vertex = [&](int row, int column) {
        return mesh.vertices[static_cast<std::size_t>(row * (columns + 1) + column)];
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            mesh.triangles.push_back({vertex(row, column), vertex(row, column + 1), vertex(row + 1, column)});
            mesh.triangles.push_back({vertex(row + 1, column), vertex(row, column + 1), vertex(row + 1, column + 1)});
        }
    }
    return mesh;
}

GeodeticBin boundsOf(const Ellipsoid& ellipsoid, const Mesh& mesh, double reference, double axisTolerance = 0.0) {
    GeodeticMeshBounds bounds(ellipsoid, reference, axisTolerance);
    for (const glm::dvec3& vertex : mesh.vertices) bounds.expandByVertex(vertex);
    for (const Triangle& t : mesh.triangles) bounds.expandByTriangle(t.a, t.b, t.c);
    return bounds.bin();
}

void expectHolds(Random& random, const Ellipsoid& ellipsoid, const Mesh& mesh, const GeodeticBin& bin, double allowance,
                 const char* what) {
    for (const Triangle& triangle : mesh.triangles) {
        for (int i = 0; i < 10; ++i) {
            const RealVector point = randomPointOf(random, triangle);
            ASSERT_LE(distanceOutside(ellipsoid, bin, point), allowance) << what;
        }
        for (const auto& corner : {triangle.a, triangle.b, triangle.c}) {
            ASSERT_LE(distanceOutside(ellipsoid, bin, real(corner)), allowance) << what;
        }
    }
}

// What one posting of a terrain tile looks like: any kind of bin that a mesh can be bent over.
GeodeticBin randomMeshBin(Random& random) {
    constexpr std::array<BinKind, 6> kKinds{BinKind::Tile,    BinKind::Polar,  BinKind::DateLine,
                                            BinKind::Equator, BinKind::Sliver, BinKind::Tiny};
    return randomBin(random, random.pick(kKinds));
}

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

TEST(GeodeticMeshBounds, HoldsEveryPointOfEveryTriangle) {
    Random random(90);
    for (int trial = 0; trial < 3000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomMeshBin(random);
        const Mesh mesh = gridMesh(random, ellipsoid, bin, random.integer(1, 4), random.integer(1, 4));
        const double reference = bin.longitude().middle() + random.uniform(-0.5, 0.5);
        expectHolds(random, ellipsoid, mesh, boundsOf(ellipsoid, mesh, reference), kMeshPromised, "grid");
    }
}

TEST(GeodeticMeshBounds, HoldsLooseTriangles) {
    // Any three points of a bin, not only neighbouring posts; also across the equator.
    Random random(91);
    for (int trial = 0; trial < 20000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const double south = random.uniform(-kHalfPi, 1.4);
        const GeodeticBin bin({south, std::min(south + random.uniform(0.0, 1.2), kHalfPi)},
                              {2.0, 2.0 + random.uniform(0.0, 1.5)}, randomAltitude(random));
        Mesh mesh;
        for (int i = 0; i < 3; ++i) mesh.vertices.push_back(ellipsoid.toEcef(randomPosition(random, bin)));
        mesh.triangles.push_back({mesh.vertices[0], mesh.vertices[1], mesh.vertices[2]});
        expectHolds(random, ellipsoid, mesh, boundsOf(ellipsoid, mesh, bin.longitude().middle()), kMeshPromised,
                    "loose");
    }
}

TEST(GeodeticMeshBounds, ChordsOfAParallelRunPoleward) {
    const Ellipsoid earth = wgs84();
    for (const double side : {1.0, -1.0}) {
        const double latitude = side * 60.0 * kRadiansPerDegree;
        const Mesh mesh = [&] {
            const glm::dvec3 a = earth.toEcef({latitude, 0.0, 0.0});
            const glm::dvec3 b = earth.toEcef({latitude, 0.2, 0.0});
            const glm::dvec3 c = earth.toEcef({latitude - side * 0.1, 0.1, 0.0});
            return Mesh{{a, b, c}, {{a, b, c}}};
        }();
        const RealGeodetic middle = ecefToGeodetic(earth, 0.5L * (real(mesh.vertices[0]) + real(mesh.vertices[1])));
        const GeodeticBin bin = boundsOf(earth, mesh, 0.1);
        const Real poleward = side * middle.latitude - std::abs(latitude);
        EXPECT_GT(poleward, 1e-3L) << "the case must be one";
        const double reach = std::max(std::abs(bin.latitude().lower), std::abs(bin.latitude().upper));
        EXPECT_GE(reach, static_cast<double>(side * middle.latitude) - 1e-14);
    }
}

TEST(GeodeticMeshBounds, ChordsSagBelowTheEllipsoid) {
    const Ellipsoid earth = wgs84();
    const glm::dvec3 a = earth.toEcef({0.0, 0.0, 0.0});
    const glm::dvec3 b = earth.toEcef({0.0, 0.1, 0.0});
    const glm::dvec3 c = earth.toEcef({0.1, 0.05, 0.0});
    const GeodeticBin bin = boundsOf(earth, {{a, b, c}, {{a, b, c}}}, 0.05);
    const double sag = earth.equatorialRadius() * (1.0 - std::cos(0.05));
    EXPECT_LE(bin.altitude().lower, -sag);
    EXPECT_LE(bin.altitude().upper, kMeshPromised);
}

TEST(GeodeticMeshBounds, HoldsMeshesAcrossTheDateLine) {
    Random random(92);
    for (int trial = 0; trial < 500; ++trial) {
        const double west = kPi - random.uniform(0.0, 0.4);
        const double south = random.uniform(-1.4, 1.2);
        const GeodeticBin bin({south, south + 0.2}, {west, west + 0.4}, {-500.0, 9000.0});
        const Mesh mesh = gridMesh(random, wgs84(), bin, 3, 3);
        for (const double reference : {west + 0.2, west + 0.2 - 2.0 * kPi}) {
            const GeodeticBin found = boundsOf(wgs84(), mesh, reference);
            ASSERT_LT(found.longitude().width(), 0.4 + 1e-9) << "not the long way round";
            expectHolds(random, wgs84(), mesh, found, kMeshPromised, "date line");
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
        Mesh mesh = gridMesh(random, wgs84(), bin, 3, 3);
        const auto shake = [&](glm::dvec3& v) {
            if (std::hypot(v.x, v.y) < 1e-3) v = {random.uniform(-1e-9, 1e-9), random.uniform(-1e-9, 1e-9), v.z};
        };
        for (glm::dvec3& v : mesh.vertices) shake(v);
        for (Triangle& t : mesh.triangles) {
            shake(t.a);
            shake(t.b);
            shake(t.c);
        }
        const GeodeticBin found = boundsOf(wgs84(), mesh, west + 0.5 * width, kAxisTolerance);
        ASSERT_LT(found.longitude().width(), width + 1e-9);
        expectHolds(random, wgs84(), mesh, found, kMeshPromised + kAxisTolerance, "pole row");
    }
}

TEST(GeodeticMeshBounds, TrianglesOverThePoleCoverTheCircle) {
    Random random(94);
    for (int trial = 0; trial < 2000; ++trial) {
        Mesh mesh;
        const double start = random.uniform(-kPi, kPi);
        const double side = random.sign();
        for (int i = 0; i < 3; ++i) {
            mesh.vertices.push_back(
                wgs84().toEcef({side * (kHalfPi - random.uniform(0.01, 0.3)),
                                start + i * 2.1 + random.uniform(-0.4, 0.4), random.uniform(-500.0, 9000.0)}));
        }
        mesh.triangles.push_back({mesh.vertices[0], mesh.vertices[1], mesh.vertices[2]});
        const GeodeticBin bin = boundsOf(wgs84(), mesh, start);
        ASSERT_TRUE(bin.isFullCircle());
        ASSERT_TRUE(bin.contains(Geodetic{side * kHalfPi, 0.0, bin.altitude().middle()}));
        expectHolds(random, wgs84(), mesh, bin, kMeshPromised, "over the pole");
    }
}

// A closed globe: one column of posts serves both sides of the date line, so some triangles run from +180 - step
// to -180 + step, or from 180 to -180 + step.
TEST(GeodeticMeshBounds, ClosedGlobesCoverTheCircle) {
    Random random(95);
    for (int trial = 0; trial < 40; ++trial) {
        const int columns = random.integer(4, 24);
        const int rows = random.integer(3, 12);
        const double first = -kPi + (random.chance(0.5) ? 0.0 : random.uniform(0.0, 1.0));
        Mesh open =
            gridMesh(random, wgs84(),
                     GeodeticBin({-1.5, 1.5}, {first, first + 2.0 * kPi * (columns - 1) / columns}, {0.0, 9000.0}),
                     rows, columns - 1);
        const auto at = [&](int row, int column) {
            return open.vertices[static_cast<std::size_t>(row * columns + column)];
        };
        for (int row = 0; row < rows; ++row) {
            open.triangles.push_back({at(row, columns - 1), at(row, 0), at(row + 1, columns - 1)});
            open.triangles.push_back({at(row + 1, columns - 1), at(row, 0), at(row + 1, 0)});
        }
        expectHolds(random, wgs84(), open, boundsOf(wgs84(), open, 0.0), kMeshPromised, "closed globe");
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
        Mesh mesh;
        for (const double west : {-180.0, -120.0, -60.0, 0.0, 60.0, 120.0}) {
            mesh.triangles.push_back({at(-0.5, west), at(-0.5, west + 60.0), at(0.5, west)});
            mesh.triangles.push_back({at(0.5, west), at(-0.5, west + 60.0), at(0.5, west + 60.0)});
            mesh.vertices.push_back(at(-0.5, west));
            mesh.vertices.push_back(at(0.5, west));
        }
        expectHolds(random, earth, mesh, boundsOf(earth, mesh, 0.0), kMeshPromised, "antimeridian column");
    }
}

TEST(GeodeticMeshBounds, IsTight) {
    // A grid over a 5.6 degree tile: longitudes exact, latitudes and altitudes wider by second-order terms only.
    Random random(96);
    double worstNorth = 0.0;
    double worstDown = 0.0;
    for (int trial = 0; trial < 300; ++trial) {
        const GeodeticBin bin = randomTile(random, 2, {-500.0, 9000.0});
        const int steps = random.integer(2, 16);
        const Mesh mesh = gridMesh(random, wgs84(), bin, steps, steps);
        const GeodeticBin found = boundsOf(wgs84(), mesh, bin.longitude().middle(), 1e-3);
        const double step = bin.latitude().width() / steps;
        ASSERT_NEAR(found.longitude().lower, bin.longitude().lower, 1e-13);
        ASSERT_NEAR(found.longitude().upper, bin.longitude().upper, 1e-13);
        ASSERT_LE(found.altitude().upper, bin.altitude().upper + kMeshPromised);
        const double poleward =
            std::max(found.latitude().upper - bin.latitude().upper, bin.latitude().lower - found.latitude().lower);
        worstNorth = std::max(worstNorth, poleward / (step * step));
        const double sag = bin.altitude().lower - found.altitude().lower;
        worstDown = std::max(worstDown, sag / (wgs84().equatorialRadius() * step * step));
    }
    std::printf("mesh bounds: poleward %.3f step^2 radians, down %.3f R step^2 (the sag itself is 0.25)\n", worstNorth,
                worstDown);
    EXPECT_LE(worstNorth, 0.25);
    EXPECT_LE(worstDown, 0.35);
}

}  // namespace
}  // namespace osgAnalyticBin::test

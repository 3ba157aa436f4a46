// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// On the earth. Every point of meshes and grids: PlanetMeshesTest. Oracles: points of the triangles, taken back to
// latitude, longitude and altitude in long double; and GeodeticMeshBounds.

#include "CoreTest.h"
#include "MeshSamples.h"

namespace osgAnalyticBin::test {
namespace {

constexpr double kAxisTolerance = 1.0;

GeodeticBin randomExtents(Random& random) {
    const double size = random.logUniform(1e-5, 0.8);
    const double south = random.chance(0.1)   ? -kHalfPi
                         : random.chance(0.1) ? kHalfPi - size
                                              : random.uniform(-kHalfPi, kHalfPi - size);
    const double west = random.uniform(-kPi, kPi);
    const double low = random.uniform(-11000.0, 8000.0);
    return GeodeticBin({south, south + size}, {west, west + size * random.uniform(0.5, 2.0)},
                       {low, random.chance(0.3) ? low : random.uniform(low, 9000.0)});
}

TEST(MeshBounds, IsHardlyLooserThanTheThoroughBounds) {
    Random random(192);
    for (int trial = 0; trial < 1000; ++trial) {
        const GeodeticBin anyExtents = randomExtents(random);
        const auto cells = static_cast<std::uint32_t>(random.integer(8, 16));
        const double step = anyExtents.latitude().width() * 2.0 / cells;
        // no steeper than terrain is: a chord that climbs is taken for one along the ground
        const double low = anyExtents.altitude().lower;
        const GeodeticBin extents = anyExtents.withAltitude({low, low + std::min(5000.0, 3e5 * step)});
        const EcefMesh mesh = gridMesh(random, wgs84(), extents, cells);
        const MeshBounds quick(wgs84(), mesh);
        if (!quick.isQuick()) continue;
        const GeodeticBin thorough = thoroughBounds(wgs84(), mesh, extents.longitude().middle(), kAxisTolerance);
        const double sag = 6.4e6 * 0.5 * step * step;
        EXPECT_LE(quick.bin().altitude().upper - thorough.altitude().upper, 0.6);
        EXPECT_LE(thorough.altitude().lower - quick.bin().altitude().lower, 0.6 + 0.2 * sag);
        EXPECT_LE(quick.sag(), 2.0 * sag + 0.1);
        const auto isSameAngle = [](double a, double b) { return std::abs(std::remainder(a - b, 2.0 * kPi)) < 1e-12; };
        EXPECT_TRUE(isSameAngle(quick.bin().longitude().lower, thorough.longitude().lower));
        EXPECT_TRUE(isSameAngle(quick.bin().longitude().upper, thorough.longitude().upper));
        const bool polar =
            std::abs(extents.latitude().lower) > kHalfPi - 1e-3 || extents.latitude().upper > kHalfPi - 1e-3;
        if (polar) continue;
        const Interval latitude = extents.latitude();
        const double steepest = std::tan(std::max(std::abs(latitude.lower), std::abs(latitude.upper)));
        const double allowed = 1e-6 + step * step * (0.1 + 0.1 * steepest);
        EXPECT_LE(quick.bin().latitude().upper - thorough.latitude().upper, allowed);
        EXPECT_LE(thorough.latitude().lower - quick.bin().latitude().lower, allowed);
    }
}

TEST(MeshBounds, IsUnknownWithoutVerticesAndWithBrokenOnes) {
    Random random(195);
    EXPECT_TRUE(MeshBounds(wgs84(), EcefMesh()).bin().empty());
    EcefMesh broken = gridMesh(random, wgs84(), GeodeticBin({0.1, 0.2}, {0.1, 0.2}, {0.0, 1000.0}), 8);
    EXPECT_TRUE(MeshBounds(wgs84(), broken).isQuick());
    broken.y[40] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(MeshBounds(wgs84(), broken).bin().empty());
}

using core::GeodeticMeshBounds;

constexpr double kMeshPromised = 1e-7;  // metres, by GeodeticMeshBounds

TEST(GeodeticMeshBounds, OneVertexIsAPoint) {
    const Geodetic position{0.4, 3.0, 1234.0};
    GeodeticMeshBounds bounds(wgs84(), 3.1);
    EXPECT_TRUE(bounds.bin().empty());
    bounds.expandByVertex(wgs84().toEcef(position));
    const GeodeticBin bin = bounds.bin();
    EXPECT_NEAR(bin.latitude().lower, position.latitude, 1e-14);
    EXPECT_NEAR(bin.longitude().lower, position.longitude, 1e-14);
    EXPECT_NEAR(bin.altitude().lower, position.altitude, kMeshPromised);
    EXPECT_EQ(bin.latitude().width() + bin.longitude().width() + bin.altitude().width(), 0.0);
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

TEST(GeodeticGridBounds, IsKnownOnPlanetsLikeTheEarth) {
    GeodeticGrid grid;
    grid.latitude = {-kHalfPi, kHalfPi};
    grid.longitude = {-kPi, kPi};
    grid.columns = 7;
    grid.rows = 4;
    for (const Planet& planet : kPlanets) {
        const Ellipsoid ellipsoid = planet.in(1.0);
        const double smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
        const bool isEarthLike = std::abs(ellipsoid.eccentricitySquared()) < 0.1;
        for (const double reach : {0.0, 0.0999 * smaller})
            EXPECT_EQ(GeodeticGridBounds(ellipsoid, grid, reach).isKnown(), isEarthLike) << planet;
        EXPECT_FALSE(GeodeticGridBounds(ellipsoid, grid, 0.1001 * smaller).isKnown()) << planet;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

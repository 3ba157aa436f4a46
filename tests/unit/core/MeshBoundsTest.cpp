// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// On the earth. Every point of meshes: PlanetMeshesTest. Oracles: points of the triangles, taken back to latitude,
// longitude and altitude in long double; and GeodeticMeshBounds.

#include "CoreTest.h"
#include "MeshSamples.h"

namespace osgAnalyticBin::test {
namespace {

constexpr double kQuickPromised = 1e-7;  // metres
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

TEST(MeshBounds, KnowsTheAltitudeOfEveryVertex) {
    Random random(193);
    for (int trial = 0; trial < 300; ++trial) {
        const EcefMesh mesh = gridMesh(random, wgs84(), randomExtents(random), 5);
        const MeshBounds bounds(wgs84(), mesh);
        if (!bounds.isQuick()) continue;
        ASSERT_EQ(bounds.altitudes().size(), mesh.size());
        EXPECT_LE(bounds.altitudeError(), 0.5);
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            const double truth = static_cast<double>(ecefToGeodetic(wgs84(), real(mesh.vertex(i))).altitude);
            EXPECT_NEAR(bounds.altitudes()[i], truth, bounds.altitudeError());
        }
    }
}

// What has no closed form is bounded triangle by triangle.
TEST(MeshBounds, HoldsMeshesWithoutAClosedForm) {
    Random random(194);
    const GeodeticBin tile({0.1, 0.2}, {0.1, 0.2}, {0.0, 1000.0});
    struct Row {
        Ellipsoid ellipsoid;
        GeodeticBin extents;
    };
    const Row rows[]{{Ellipsoid(6.4e6, 6.0e6), tile},
                     {wgs84(), tile.withAltitude({-300000.0, 0.0})},
                     {wgs84(), GeodeticBin::wholeGlobe({0.0, 0.0})},
                     {wgs84(), GeodeticBin({0.3, kHalfPi}, {-1.0, 1.0}, {0.0, 3000.0})}};
    for (const Row& row : rows) {
        const EcefMesh mesh = gridMesh(random, row.ellipsoid, row.extents, 8);
        const MeshBounds bounds(row.ellipsoid, mesh);
        EXPECT_FALSE(bounds.isQuick());
        ASSERT_FALSE(bounds.bin().empty());
        const double allowed = bounds.touchesAxis() ? kAxisTolerance : kQuickPromised;
        expectHolds(random, row.ellipsoid, mesh, bounds.bin(), allowed);
        EXPECT_EQ(bounds.touchesAxis(), row.extents.latitude().upper == kHalfPi);
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            const double truth = static_cast<double>(ecefToGeodetic(row.ellipsoid, real(mesh.vertex(i))).altitude);
            EXPECT_NEAR(bounds.altitudes()[i], truth, bounds.altitudeError());
            EXPECT_LE(bounds.bin().altitude().lower, truth - bounds.sag() + 2.0 * bounds.altitudeError());
        }
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

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// On the earth. Every point of meshes: PlanetMeshesTest. Oracles: points of the triangles, of random cells of a grid
// with diagonals either way, taken back to latitude, longitude and altitude in long double; and GeodeticMeshBounds.

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
    constexpr double kPolarTolerance = 1e-3;
    Random random(93);
    for (int trial = 0; trial < 500; ++trial) {
        const double side = random.sign(), width = random.uniform(0.01, 0.4), west = random.uniform(-kPi, kPi);
        const Interval latitude =
            side > 0.0 ? Interval{kHalfPi - width, kHalfPi} : Interval{-kHalfPi, -kHalfPi + width};
        const GeodeticBin bin(latitude, {west, west + width}, {-500.0, 9000.0});
        EcefMesh mesh = gridMesh(random, wgs84(), bin, 3);
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            if (std::hypot(mesh.x[i], mesh.y[i]) >= 1e-3) continue;
            mesh.x[i] = random.uniform(-1e-9, 1e-9);
            mesh.y[i] = random.uniform(-1e-9, 1e-9);
        }
        const GeodeticBin found = thoroughBounds(wgs84(), mesh, west + 0.5 * width, kPolarTolerance);
        ASSERT_LT(found.longitude().width(), width + 1e-9);
        expectHolds(random, wgs84(), mesh, found, kMeshPromised + kPolarTolerance);
    }
}

TEST(GeodeticMeshBounds, TrianglesOverThePoleCoverTheCircle) {
    Random random(94);
    for (int trial = 0; trial < 2000; ++trial) {
        EcefMesh mesh;
        const double start = random.uniform(-kPi, kPi), side = random.sign();
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

constexpr double kPromisedSag = 1e-7;  // metres

GeodeticGrid randomGrid(Random& random) {
    GeodeticGrid grid;
    grid.columns = static_cast<std::size_t>(random.integer(8, 65));
    grid.rows = static_cast<std::size_t>(random.integer(5, 65));
    const double height = random.chance(0.1) ? kPi : random.logUniform(1e-5, 1.5);
    const double south = height == kPi ? -kHalfPi : random.uniform(-kHalfPi, kHalfPi - height);
    const bool toPole = random.chance(0.2);
    grid.latitude = {south, toPole ? kHalfPi : std::min(kHalfPi, south + height)};
    const double west = random.uniform(-kPi, kPi);
    grid.longitude = {west, west + (random.chance(0.1) ? 2.0 * kPi : random.logUniform(1e-5, 3.0))};
    return grid;
}

TEST(GeodeticGridBounds, HoldsTheChordsOfEveryEdge) {
    Random random(181);
    for (int trial = 0; trial < 1000; ++trial) {
        const GeodeticGrid grid = randomGrid(random);
        const GeodeticGridBounds bounds(wgs84(), grid, 9000.0);
        const int east = static_cast<int>(grid.columns) - 1, north = static_cast<int>(grid.rows) - 1;
        const int column = random.integer(0, east - 1), row = random.integer(0, north - 1);
        const std::array<std::array<int, 4>, 4> chords{{{column, 0, column + 1, 0},
                                                        {east, row, east, row + 1},
                                                        {column, north, column + 1, north},
                                                        {0, row, 0, row + 1}}};
        for (std::size_t edge = 0; edge < 4; ++edge) {
            const double lower = random.uniform(-9000.0, 9000.0), upper = random.uniform(lower, 9000.0);
            const auto [i, j, k, l] = chords[edge];
            const glm::dvec3 a =
                wgs84().toEcef({postAt(grid.latitude, j, grid.rows), postAt(grid.longitude, i, grid.columns), lower});
            const glm::dvec3 b =
                wgs84().toEcef({postAt(grid.latitude, l, grid.rows), postAt(grid.longitude, k, grid.columns), upper});
            for (int step = 0; step <= 8; ++step) {
                const Real t = step / Real(8);
                const RealVector point = (1 - t) * real(a) + t * real(b);
                ASSERT_GE(ecefToGeodetic(wgs84(), point).altitude + kPromisedSag, lower - bounds.edgeSag()[edge]);
            }
            EXPECT_LE(bounds.edgeSag()[edge], bounds.sag() + kPromisedSag);
        }
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

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// On the earth. Every point of meshes and grids: PlanetMeshesTest. Oracles: points of the triangles, taken back to
// latitude, longitude and altitude in long double; and GeodeticMeshBounds. MeshCover: a mesh fills its rectangle only
// where every normal meets a front face. Oracles: meshes that are whole by construction, with and without a triangle;
// lines along the normals of random places, against all triangles.

#include "CoreTest.h"
#include "OcclusionScene.h"

namespace osgAnalyticBin::test {
namespace {

constexpr double kAxisTolerance = 1.0;

TEST(MeshBounds, IsHardlyLooserThanTheThoroughBounds) {
    Random random(192);
    for (int trial = 0; trial < 1000; ++trial) {
        const GeodeticBin anyExtents = randomExtents(random, wgs84(), 0.8, 0.0015);
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
        const bool isEarthLike = std::abs(ellipsoid.eccentricitySquared()) < 0.1;
        for (const double reach : {0.0, 0.0999 * smaller(ellipsoid)})
            EXPECT_EQ(GeodeticGridBounds(ellipsoid, grid, reach).isKnown(), isEarthLike) << planet;
        EXPECT_FALSE(GeodeticGridBounds(ellipsoid, grid, 0.1001 * smaller(ellipsoid)).isKnown()) << planet;
    }
}

constexpr double kDegree = kRadiansPerDegree;
const Ellipsoid kEarth = wgs84();

GeodeticBin extentsDeg(double south, double north, double west, double east) {
    const double relief = std::min(1.0, north - south);
    return {{south * kDegree, north * kDegree}, {west * kDegree, east * kDegree}, {-400.0 * relief, 3000.0 * relief}};
}

// Poles, the date line, many turns around, tiles of any size, and the whole globe.
const std::vector<GeodeticBin> kExtents{
    extentsDeg(0.0, 45.0, 0.0, 45.0),      extentsDeg(45.0, 90.0, 90.0, 135.0),  extentsDeg(-90.0, -45.0, 0.0, 45.0),
    extentsDeg(-90.0, 90.0, -180.0, 0.0),  extentsDeg(-90.0, 90.0, 0.0, 180.0),  extentsDeg(-90.0, 90.0, -180.0, 180.0),
    extentsDeg(10.0, 11.0, 179.5, 180.5),  extentsDeg(47.0, 47.01, 8.0, 8.01),   extentsDeg(60.0, 90.0, -180.0, 180.0),
    extentsDeg(-20.0, 20.0, 170.0, 350.0), extentsDeg(-40.0, 30.0, -30.0, 170.0)};

double tolerance(const Interval& interval) {
    return 2.0 * core::MeshCover::kTolerance * interval.width();
}

void expectSame(const GeodeticBin& place, const GeodeticBin& extents) {
    ASSERT_FALSE(place.empty());
    EXPECT_NEAR(place.latitude().lower, extents.latitude().lower, tolerance(extents.latitude()));
    EXPECT_NEAR(place.latitude().upper, extents.latitude().upper, tolerance(extents.latitude()));
    EXPECT_NEAR(place.longitude().width(), extents.longitude().width(), tolerance(extents.longitude()));
    const double turn = std::remainder(place.longitude().lower - extents.longitude().lower, 2.0 * kPi);
    EXPECT_NEAR(extents.isFullCircle() ? 0.0 : turn, 0.0, tolerance(extents.longitude()));
}

std::array<std::uint32_t, 3> cornersAt(const EcefMesh& mesh, std::size_t first) {
    return {mesh.triangles[first], mesh.triangles[first + 1], mesh.triangles[first + 2]};
}

EcefMesh without(const EcefMesh& mesh, std::size_t first) {
    EcefMesh less = mesh;
    const auto at = less.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    less.triangles.erase(at, at + 3);
    return less;
}

// Front faces less back faces on the normal through a place, far from edges by chance.
int facesAt(const EcefMesh& mesh, const Geodetic& at) {
    const glm::dvec3 foot = kEarth.toEcef({at.latitude, at.longitude, 0.0}), up = kEarth.up(at.latitude, at.longitude);
    int count = 0;
    for (std::size_t first = 0; first + 2 < mesh.triangles.size(); first += 3) {
        const Triangle t = triangleAt(mesh, first);
        if (!meets(t, real(foot - 3e6 * up), real(foot + 3e6 * up))) continue;
        count += glm::dot(glm::cross(t.b - t.a, t.c - t.a), up) > 0.0 ? 1 : -1;
    }
    return count;
}

TEST(MeshCover, IsThatOfAGridWithAndWithoutSkirts) {
    Random random(1);
    for (const GeodeticBin& extents : kExtents) {
        for (const std::uint32_t cells : {9U, 17U}) {
            const EcefMesh grid = gridMesh(random, kEarth, extents, cells);
            for (const EcefMesh& mesh : {grid, withSkirts(kEarth, grid, cells, 2000.0), unmerged(grid)}) {
                const core::MeshCover cover = core::MeshCover::of(kEarth, mesh);
                EXPECT_TRUE(cover.isFilled) << extents.latitude().lower / kDegree << ' ' << cells;
                expectSame(cover.place, extents);
            }
        }
    }
}

TEST(MeshCover, EndsWhereAVertexOfTheBorderIsWithinIt) {
    Random random(4);
    const GeodeticBin extents = extentsDeg(10.0, 20.0, 30.0, 40.0);
    const double metre = 1.0 / 6335439.0;  // radians of latitude
    for (const double metres : {0.5, 5.0, 500.0, 20000.0}) {
        EcefMesh mesh = gridMesh(random, kEarth, extents, 9);
        moveVertex(mesh, 4, glm::dvec3(0.0, 0.0, metres));  // northward, into the place
        const core::MeshCover cover = core::MeshCover::of(kEarth, mesh);
        EXPECT_EQ(cover.isFilled, metres < 1000.0) << metres;
        if (!cover.isFilled) continue;
        EXPECT_NEAR(cover.place.latitude().lower, extents.latitude().lower + 0.98 * metres * metre,
                    0.03 * metres * metre);
        // a vertex within does not matter
        EcefMesh within = gridMesh(random, kEarth, extents, 9);
        moveVertex(within, 44, glm::dvec3(0.0, 0.0, metres));
        const core::MeshCover same = core::MeshCover::of(kEarth, within);
        EXPECT_TRUE(same.isFilled) << metres;
        expectSame(same.place, extents);
    }
}

// Float vertices about the tile's middle.
TEST(MeshCover, IsFilledByRoundedVertices) {
    Random random(5);
    for (const GeodeticBin& extents : kExtents) {
        EcefMesh mesh = gridMesh(random, kEarth, extents, 16);
        const Geodetic middle{extents.latitude().middle(), extents.longitude().middle(), 0.0};
        const glm::dvec3 origin = extents.isFullCircle() ? glm::dvec3(0.0) : kEarth.toEcef(middle);
        const auto rounded = [](double value, double about) {
            return about + static_cast<double>(static_cast<float>(value - about));
        };
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            mesh.x[i] = rounded(mesh.x[i], origin.x);
            mesh.y[i] = rounded(mesh.y[i], origin.y);
            mesh.z[i] = rounded(mesh.z[i], origin.z);
        }
        const core::MeshCover cover = core::MeshCover::of(kEarth, mesh);
        EXPECT_TRUE(cover.isFilled) << extents.latitude().lower / kDegree << ' ' << extents.longitude().lower / kDegree;
        expectSame(cover.place, extents);
    }
}

TEST(MeshCover, IsThatOfAMap) {
    constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
    Random random(7);
    const Ellipsoid plane = Ellipsoid::plane();
    const GeodeticBin extents({4600000.0 / kUnits, 4601000.0 / kUnits}, {500000.0 / kUnits, 501000.0 / kUnits},
                              {0.0, 60.0});
    const EcefMesh mesh = gridMesh(random, plane, extents, 4);
    const core::MeshCover cover = core::MeshCover::of(plane, mesh);
    EXPECT_TRUE(cover.isFilled);
    EXPECT_NEAR(cover.place.longitude().width() * kUnits, 1000.0, 1e-3);
    for (std::size_t first = 0; first + 2 < mesh.triangles.size(); first += 3)
        EXPECT_FALSE(core::MeshCover::of(plane, without(mesh, first)).isFilled);
}

// Triangles taken away, turned around, doubled, moved: whatever is left, it is filled only where it says so.
TEST(MeshCover, HasAFrontFaceOnEachNormalOfAFilledPlace) {
    Random random(6);
    int filled = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const GeodeticBin& extents = kExtents[static_cast<std::size_t>(random.integer(0, 10))];
        const auto cells = static_cast<std::uint32_t>(random.integer(8, 10));
        EcefMesh mesh = gridMesh(random, kEarth, extents, cells);
        if (random.chance(0.5)) mesh = withSkirts(kEarth, mesh, cells, random.logUniform(10.0, 20000.0));
        for (int change = random.integer(0, 2); change > 0; --change) {
            const auto last = static_cast<int>(mesh.triangles.size() / 3) - 1;
            const auto first = static_cast<std::size_t>(3 * random.integer(0, last));
            const auto corners = cornersAt(mesh, first);
            switch (random.integer(0, 4)) {
                case 0:
                    mesh = without(mesh, first);
                    break;
                case 1:
                    std::swap(mesh.triangles[first], mesh.triangles[first + 1]);
                    break;
                case 2:
                    mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
                    break;
                case 3:
                    mesh.triangles.insert(mesh.triangles.end(), {corners[1], corners[0], corners[2]});
                    break;
                default:
                    moveVertex(mesh, corners[0], random.logUniform(1.0, 1e5) * random.direction());
                    break;
            }
        }
        const core::MeshCover cover = core::MeshCover::of(kEarth, mesh);
        if (!cover.isFilled) continue;
        ++filled;
        for (int i = 0; i < 40; ++i) {
            // chords along parallels bulge toward the pole
            const double south = cover.place.latitude().lower, north = cover.place.latitude().upper;
            const double cell = extents.longitude().width() / static_cast<double>(cells), bulge = 0.14 * cell * cell;
            const double lower =
                south <= -1.5707 ? south : south + (south > -1e-6 ? bulge : 0.0) + 1e-5 * (north - south);
            const double upper =
                north >= 1.5707 ? north : north - (north < 1e-6 ? bulge : 0.0) - 1e-5 * (north - south);
            const Geodetic at{
                random.uniform(lower, upper),
                cover.place.longitude().lower + cover.place.longitude().width() * random.uniform(1e-5, 1.0 - 1e-5),
                0.0};
            EXPECT_GT(facesAt(mesh, at), 0) << trial << ' ' << at.latitude / kDegree << ' ' << at.longitude / kDegree;
        }
    }
    EXPECT_GT(filled, 300);
}

}  // namespace
}  // namespace osgAnalyticBin::test

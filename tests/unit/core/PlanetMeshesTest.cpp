// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Bounds of meshes and of grids on ellipsoids from an 11 km body to Saturn, oblate and prolate extremes. Oracle: points
// of the triangles, taken back to latitude, longitude and altitude in long double.

#include "CoreTest.h"
#include "MeshSamples.h"

#include <string>

namespace osgAnalyticBin::test {
namespace {

constexpr double kPromised = 1.6e-14;  // of the larger radius
constexpr double kRound = 0.01;        // |a2/b2 - 1| up to which there are quick bounds

// A metre on the earth.
double axisTolerance(const Ellipsoid& e) {
    return e.equatorialRadius() / 6378137.0;
}

bool isRound(const Ellipsoid& e) {
    const double ratio = e.equatorialRadius() / e.polarRadius();
    return std::abs(ratio * ratio - 1.0) <= kRound;
}

// Where the points of a mesh are, by a dense lattice on every triangle.
struct Truth {
    double lowest = 1e300;
    double northernmost = -1e300;

    Truth(const Ellipsoid& ellipsoid, const EcefMesh& mesh) {
        constexpr int kSteps = 8;
        for (std::size_t first = 0; first < mesh.triangles.size(); first += 3) {
            const Triangle t = triangleAt(mesh, first);
            for (int i = 0; i <= kSteps; ++i) {
                for (int j = 0; i + j <= kSteps; ++j) {
                    const RealVector point = Real(i) / kSteps * real(t.a) + Real(j) / kSteps * real(t.b) +
                                             Real(kSteps - i - j) / kSteps * real(t.c);
                    const RealGeodetic at = ecefToGeodetic(ellipsoid, point);
                    lowest = std::min(lowest, static_cast<double>(at.altitude));
                    northernmost = std::max(northernmost, static_cast<double>(at.latitude));
                }
            }
        }
    }
};

class PlanetMeshes : public ::testing::TestWithParam<Planet> {
protected:
    [[nodiscard]] Ellipsoid in(double unit) const { return GetParam().in(unit); }

    Random random{1201};
};

TEST_P(PlanetMeshes, ThoroughBoundsHoldEveryPoint) {
    const Ellipsoid ellipsoid = in(1.0);
    for (int trial = 0; trial < 150; ++trial) {
        const GeodeticBin extents = randomExtents(random, ellipsoid, 0.6, random.chance(0.5) ? 0.002 : 0.08);
        const auto cells = static_cast<std::uint32_t>(random.integer(2, 5));
        EcefMesh mesh = gridMesh(random, ellipsoid, extents, cells);
        // a row at a pole is one point, each of whose copies has a rounding error for a longitude
        const double rounding = 1e-16 * larger(ellipsoid);
        for (std::size_t i = 0; i < mesh.size(); ++i)
            if (std::hypot(mesh.x[i], mesh.y[i]) < 2.0 * rounding) moveVertex(mesh, i, rounding * random.direction());
        const double reference = extents.longitude().middle() + 2.0 * kPi * random.integer(-1, 1);
        const GeodeticBin bin = thoroughBounds(ellipsoid, mesh, reference, axisTolerance(ellipsoid));
        ASSERT_FALSE(bin.empty());
        ASSERT_LT(bin.longitude().width(), extents.longitude().width() + 1e-9);
        const bool isPolar = extents.latitude().lower == -kHalfPi || extents.latitude().upper == kHalfPi;
        const double offset = isPolar ? axisTolerance(ellipsoid) : 0.0;
        expectHolds(random, ellipsoid, mesh, bin, offset + kPromised * larger(ellipsoid));
        if (HasFatalFailure()) return;
    }
}

// What has no closed form is bounded triangle by triangle.
TEST_P(PlanetMeshes, BoundsHoldEveryPointAndKnowTheAltitudeOfEveryVertex) {
    const Ellipsoid ellipsoid = in(1.0);
    int quick = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const GeodeticBin extents = randomExtents(random, ellipsoid, 0.6, 0.0017);
        const auto cells = static_cast<std::uint32_t>(random.integer(2, 9));
        const EcefMesh mesh = gridMesh(random, ellipsoid, extents, cells);
        const MeshBounds bounds(ellipsoid, mesh);
        ASSERT_EQ(bounds.altitudes().size(), mesh.size());
        quick += bounds.isQuick() ? 1 : 0;
        const double offset = bounds.touchesAxis() ? axisTolerance(ellipsoid) : 0.0;
        expectHolds(random, ellipsoid, mesh, bounds.bin(), offset + kPromised * larger(ellipsoid));
        if (HasFatalFailure()) return;
        EXPECT_LE(bounds.altitudeError(), 1e-7 * larger(ellipsoid));
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            const auto truth = static_cast<double>(ecefToGeodetic(ellipsoid, real(mesh.vertex(i))).altitude);
            ASSERT_NEAR(bounds.altitudes()[i], truth, bounds.altitudeError());
            ASSERT_TRUE(bounds.isQuick() ||
                        bounds.bin().altitude().lower <= truth - bounds.sag() + 2.0 * bounds.altitudeError());
        }
        if (trial % 5 != 0) continue;
        const double lowestPost = *std::min_element(bounds.altitudes().begin(), bounds.altitudes().end());
        EXPECT_LE(lowestPost - Truth(ellipsoid, mesh).lowest, bounds.sag() + 2.0 * bounds.altitudeError());
    }
    EXPECT_TRUE(isRound(ellipsoid) ? quick > 130 : quick == 0) << quick;
}

// A triangle may sag as a chord as long as two thirds of its longest side does, and be found out for the whole.
TEST_P(PlanetMeshes, BoundsOfFlatMeshesAreTight) {
    const Ellipsoid ellipsoid = in(1.0);
    const double a = ellipsoid.equatorialRadius();
    const double flattening = std::max(1.0, a / ellipsoid.polarRadius());
    for (int trial = 0; trial < 10; ++trial) {
        const double size = random.logUniform(0.01, 0.4);
        const double south = random.uniform(0.0, 1.1);
        const GeodeticBin extents({south, south + size}, {0.5, 0.5 + size}, {0.0, 0.0});
        const EcefMesh mesh = gridMesh(random, ellipsoid, extents, 8);
        const Truth truth(ellipsoid, mesh);
        const GeodeticBin bin = thoroughBounds(ellipsoid, mesh, 0.5, axisTolerance(ellipsoid));
        EXPECT_LE(-bin.altitude().lower, 1.8 * -truth.lowest);
        EXPECT_LE(bin.altitude().upper, kPromised * larger(ellipsoid));
        const double step = size / 8.0;
        const double turn = step * step * flattening * flattening;
        EXPECT_LE(bin.latitude().upper - truth.northernmost, 0.25 * turn);

        const MeshBounds quick(ellipsoid, mesh);
        EXPECT_EQ(quick.isQuick(), isRound(ellipsoid));
        if (!quick.isQuick()) continue;
        const double rounding = 1e-12 * a;
        EXPECT_LE(-quick.bin().altitude().lower, 1.2 * -truth.lowest + rounding);
        EXPECT_LE(quick.sag(), 1.2 * -truth.lowest + rounding);
        EXPECT_LE(quick.bin().altitude().upper, rounding);
        EXPECT_LE(quick.bin().latitude().upper - truth.northernmost, turn);
    }
}

// A power of two is no rounding: nothing else may depend on the unit.
TEST_P(PlanetMeshes, BoundsAreTheSameInEveryUnit) {
    const Ellipsoid metres = in(1.0);
    for (const double unit : {0x1p-10, 0x1p-22, 0x1p-30, 0x1p7}) {
        const Ellipsoid ellipsoid = in(unit);
        for (int trial = 0; trial < 40; ++trial) {
            const GeodeticBin extents = randomExtents(random, metres, 0.3, 0.05);
            const EcefMesh mesh = gridMesh(random, metres, extents, 7);
            EcefMesh scaled = mesh;
            for (std::vector<double>* axis : {&scaled.x, &scaled.y, &scaled.z})
                for (double& x : *axis) x *= unit;
            const auto expectSame = [&](const GeodeticBin& expected, const GeodeticBin& found) {
                EXPECT_EQ(found.empty(), expected.empty());
                if (expected.empty()) return;
                EXPECT_EQ(found.latitude(), expected.latitude());
                EXPECT_EQ(found.longitude(), expected.longitude());
                EXPECT_EQ(found.altitude().lower, unit * expected.altitude().lower);
                EXPECT_EQ(found.altitude().upper, unit * expected.altitude().upper);
            };
            const double reference = extents.longitude().middle();
            expectSame(thoroughBounds(metres, mesh, reference, axisTolerance(metres)),
                       thoroughBounds(ellipsoid, scaled, reference, axisTolerance(ellipsoid)));
            const MeshBounds expected(metres, mesh);
            const MeshBounds found(ellipsoid, scaled);
            expectSame(expected.bin(), found.bin());
            EXPECT_EQ(found.touchesAxis(), expected.touchesAxis());
            EXPECT_TRUE(!expected.isQuick() || found.sag() == unit * expected.sag());

            const GeodeticGrid grid{extents.latitude(), extents.longitude(), 9, 9};
            const double reach = random.uniform(0.0, 0.2) * smaller(metres);
            const GeodeticGridBounds gridExpected(metres, grid, reach);
            const GeodeticGridBounds gridFound(ellipsoid, grid, unit * reach);
            EXPECT_EQ(gridFound.latitude(), gridExpected.latitude());
            EXPECT_EQ(gridFound.sag(), unit * gridExpected.sag());

            const Interval& altitude = extents.altitude();
            const GeodeticBin tile = extents.withAltitude({unit * altitude.lower, unit * altitude.upper});
            for (const bool isGrid : {false, true})
                EXPECT_EQ(sagOfFinerMeshes(ellipsoid, tile, isGrid), unit * sagOfFinerMeshes(metres, extents, isGrid));
        }
    }
}

// Through the middle of the globe there are no latitudes that a bound could hold: such meshes are unknown.
TEST_P(PlanetMeshes, AnyTriangleIsHeldOrUnknown) {
    const Ellipsoid ellipsoid = in(1.0);
    int known = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const double size = random.logUniform(0.05, 2.0);
        const glm::dvec3 middle = random.direction() * random.uniform(0.0, 1.2);
        EcefMesh mesh;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 corner = middle + random.direction() * size;
            addVertex(mesh, {corner.x * ellipsoid.equatorialRadius(), corner.y * ellipsoid.equatorialRadius(),
                             (random.chance(0.1) ? 0.0 : corner.z) * ellipsoid.polarRadius()});
        }
        mesh.triangles = {0, 1, 2};
        const double reference = std::atan2(middle.y, middle.x);
        const GeodeticBin thorough = thoroughBounds(ellipsoid, mesh, reference, axisTolerance(ellipsoid));
        const double offset = 1e-12 * larger(ellipsoid) + axisTolerance(ellipsoid);
        known += thorough.empty() ? 0 : 1;
        if (!thorough.empty()) expectHolds(random, ellipsoid, mesh, thorough, offset);
        const MeshBounds quick(ellipsoid, mesh);
        if (!quick.bin().empty()) expectHolds(random, ellipsoid, mesh, quick.bin(), offset);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(known, 150);
}

TEST_P(PlanetMeshes, GridBoundsHoldEveryPoint) {
    const Ellipsoid ellipsoid = in(1.0);
    const double deepest = 0.5 * smallestCurvatureRadius(ellipsoid);
    for (int trial = 0; trial < 100; ++trial) {
        const GeodeticBin extents = randomExtents(random, ellipsoid, 1.5, 0.0);
        const auto posts = static_cast<std::size_t>(random.integer(5, 33));
        const GeodeticGrid grid{extents.latitude(), extents.longitude(), posts, posts};
        const double reach = smaller(ellipsoid) * (random.chance(0.2) ? 0.0 : random.logUniform(1e-6, 0.3));
        const double skirt = smaller(ellipsoid) * (random.chance(0.3) ? 0.0 : random.logUniform(1e-6, 0.4));
        const GeodeticGridBounds bounds(ellipsoid, grid, reach, skirt);
        if (!bounds.isKnown()) continue;
        const double low = random.uniform(-std::min(reach, deepest), reach);
        const Interval altitude{low, random.uniform(low, reach)};
        const GeodeticBin bin(bounds.latitude(), grid.longitude, {altitude.lower - bounds.sag(), altitude.upper});
        for (int i = 0; i < 10; ++i) {
            for (const Triangle& triangle : GridCell(random, ellipsoid, grid, altitude).triangles()) {
                for (int k = 0; k < 5; ++k) {
                    const RealVector point = randomPointOf(random, triangle);
                    ASSERT_LE(distanceOutside(ellipsoid, bin, point), kPromised * larger(ellipsoid)) << trial;
                }
            }
            // skirts on parallels: a chord between the verticals of two posts
            const int last = static_cast<int>(posts) - 1, at = random.integer(0, last - 1),
                      row = random.pick(std::array<int, 2>{0, last});
            const auto post = [&](int column) {
                const double up = random.uniform(altitude.lower, altitude.upper) - random.uniform() * skirt;
                return real(
                    ellipsoid.toEcef({postAt(grid.latitude, row, posts), postAt(grid.longitude, column, posts), up}));
            };
            const Real share = random.uniform();
            const RealVector hanging = (1 - share) * post(at) + share * post(at + 1);
            const GeodeticBin whole = bin.withAltitude({bin.altitude().lower - skirt, altitude.upper});
            ASSERT_LE(distanceOutside(ellipsoid, whole, hanging), kPromised * larger(ellipsoid)) << trial;
        }
    }
}

// Where the surface is as flat as anywhere, or as curved along the meridian as anywhere: what the bounds go by.
TEST_P(PlanetMeshes, GridBoundsAreTight) {
    const Ellipsoid ellipsoid = in(1.0);
    const double axes = larger(ellipsoid) / smaller(ellipsoid);
    for (const double south : {0.1, 0.5, 0.9, 1.3}) {
        const GeodeticGrid grid{{south, south + 0.1}, {0.0, 0.1}, 11, 11};
        const GeodeticGridBounds bounds(ellipsoid, grid, 0.0);
        if (!bounds.isKnown()) continue;
        const auto altitudeBetween = [&](const glm::dvec3& p, const glm::dvec3& q) {
            return static_cast<double>(ecefToGeodetic(ellipsoid, Real(0.5L) * (real(p) + real(q))).altitude);
        };
        const glm::dvec3 southWest = ellipsoid.toEcef({south, 0.0, 0.0});
        const glm::dvec3 northEast = ellipsoid.toEcef({south + 0.01, 0.01, 0.0});
        const double worst = axes * axes * axes;
        EXPECT_LE(bounds.sag(), 1.05 * worst * -altitudeBetween(southWest, northEast));
        const glm::dvec3 northWest = ellipsoid.toEcef({south + 0.1, 0.0, 0.0});
        const glm::dvec3 next = ellipsoid.toEcef({south + 0.1, 0.01, 0.0});
        const RealGeodetic middle = ecefToGeodetic(ellipsoid, Real(0.5L) * (real(northWest) + real(next)));
        const double run = static_cast<double>(middle.latitude) - (south + 0.1);
        EXPECT_LE(bounds.latitude().upper - (south + 0.1), 1.1 * std::max(1.0, axes * axes) * run + 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(All, PlanetMeshes, ::testing::ValuesIn(kPlanets),
                         [](const auto& planet) { return std::string(planet.param.name); });

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: points of the triangles of random cells of a grid, diagonals either way, taken back to latitude, longitude
// and altitude in long double.

#include "CoreTest.h"
#include "MeshSamples.h"

namespace osgAnalyticBin::test {
namespace {

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
        const int east = static_cast<int>(grid.columns) - 1;
        const int north = static_cast<int>(grid.rows) - 1;
        const int column = random.integer(0, east - 1);
        const int row = random.integer(0, north - 1);
        const std::array<std::array<int, 4>, 4> chords{{{column, 0, column + 1, 0},
                                                        {east, row, east, row + 1},
                                                        {column, north, column + 1, north},
                                                        {0, row, 0, row + 1}}};
        for (std::size_t edge = 0; edge < 4; ++edge) {
            const double lower = random.uniform(-9000.0, 9000.0);
            const double upper = random.uniform(lower, 9000.0);
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
        for (const double reach : {0.0, 0.0999 * smaller}) {
            EXPECT_EQ(GeodeticGridBounds(ellipsoid, grid, reach).isKnown(), isEarthLike) << planet;
        }
        EXPECT_FALSE(GeodeticGridBounds(ellipsoid, grid, 0.1001 * smaller).isKnown()) << planet;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

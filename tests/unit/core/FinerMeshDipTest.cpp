// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How deep meshes that are finer than a tile dip below their posts. Oracle: points of chords and triangles in long
// double.

#include "CrackSamples.h"

namespace osgAnalyticBin::core::cracks {
namespace {

// A part of the tile that its children, or theirs, may be.
Tile randomDescendant(const Tile& tile, Random& random) {
    const int deeper = random.integer(1, 2);
    Tile part = tile;
    for (int i = 0; i < deeper; ++i) {
        const int rows = part.level == 0 ? 1 : 2;
        part = {part.level + 1, 2 * part.x + random.integer(0, 1), rows * part.y + random.integer(0, rows - 1)};
    }
    return part;
}

// The deepest of a triangle's points below `lowest`.
double dipOf(const Ellipsoid& ellipsoid, const std::array<RealVector, 3>& corners, double lowest) {
    constexpr int kSteps = 6;
    double dip = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps - i; ++j) {
            const RealVector point = Real(i) / kSteps * corners[0] + Real(j) / kSteps * corners[1] +
                                     Real(kSteps - i - j) / kSteps * corners[2];
            dip = std::max(dip, lowest - altitudeOf(ellipsoid, point));
        }
    }
    return dip;
}

double dipOfCells(const Ellipsoid& ellipsoid, const Tile& part, int cells, Random& random) {
    const Heights heights(ellipsoid, random);
    const double lat = part.height() / cells;
    const double lon = part.width() / cells;
    double dip = 0.0;
    for (const int row : {0, cells - 1, random.integer(0, cells - 1)}) {
        const double south = part.south() + row * lat;
        const double west = part.west() + random.integer(0, cells - 1) * lon;
        const RealVector sw = post(ellipsoid, south, west, heights.next());
        const RealVector se = post(ellipsoid, south, west + lon, heights.next());
        const RealVector nw = post(ellipsoid, south + lat, west, heights.next());
        const RealVector ne = post(ellipsoid, south + lat, west + lon, heights.next());
        for (const auto& triangle : {std::array<RealVector, 3>{sw, se, ne}, std::array<RealVector, 3>{sw, ne, nw},
                                     std::array<RealVector, 3>{sw, se, nw}, std::array<RealVector, 3>{se, ne, nw}})
            dip = std::max(dip, dipOf(ellipsoid, triangle, heights.lowest()));
    }
    return dip;
}

TEST(CrackBounds, NoFinerGridDipsDeeper) {
    Random random(1705);
    for (const Ellipsoid& ellipsoid : ellipsoids()) {
        for (int trial = 0; trial < 60; ++trial) {
            const Tile tile = Tile::random(random, 0, 9);
            const double bound = sagOfFinerMeshes(ellipsoid, tile.bin(), true);
            const Tile part = randomDescendant(tile, random);
            ASSERT_LE(dipOfCells(ellipsoid, part, randomCells(random), random), bound + roundingOn(ellipsoid))
                << tile.level << " " << tile.x << " " << tile.y << " / " << part.level;
        }
    }
}

TEST(CrackBounds, NoFinerTriangleDipsDeeper) {
    Random random(1706);
    for (const Ellipsoid& ellipsoid : ellipsoids()) {
        for (int trial = 0; trial < 200; ++trial) {
            const Tile tile = Tile::random(random, 1, 9);
            const double bound = sagOfFinerMeshes(ellipsoid, tile.bin(), false);
            const Tile part = randomDescendant(tile, random);
            const Heights heights(ellipsoid, random);
            const auto corner = [&] {
                const auto share = [&] { return random.chance(0.6) ? double(random.chance(0.5)) : random.uniform(); };
                const double latitude = part.south() + share() * part.height();
                return post(ellipsoid, latitude, part.west() + share() * part.width(), heights.next());
            };
            ASSERT_LE(dipOf(ellipsoid, {corner(), corner(), corner()}, heights.lowest()), bound + roundingOn(ellipsoid))
                << tile.level << " " << tile.x << " " << tile.y << " / " << part.level;
        }
    }
}

TEST(CrackBounds, FinerMeshesNearlyDipAsDeep) {
    Random random(1707);
    for (int trial = 0; trial < 300; ++trial) {
        const Ellipsoid& ellipsoid = kEarth;
        const Tile tile = Tile::random(random, 3, 9);
        // the part nearest to the equator
        const bool isNorth = tile.south() >= 0.0;
        const Tile part{tile.level + 1, 2 * tile.x, 2 * tile.y + (isNorth ? 0 : 1)};
        const double south = part.south(), north = part.south() + part.height();
        const double west = part.west(), east = part.west() + part.width();
        const double near = isNorth ? south : north;
        const std::array<RealVector, 3> half{post(ellipsoid, near, west, 0.0), post(ellipsoid, near, east, 0.0),
                                             post(ellipsoid, isNorth ? north : south, east, 0.0)};
        EXPECT_LE(sagOfFinerMeshes(ellipsoid, tile.bin(), false), 1.4 * dipOf(ellipsoid, half, 0.0));
        const double step = part.width() / kFewestCells;
        const double far = near + (isNorth ? step : -step);
        const std::array<RealVector, 3> cell{post(ellipsoid, near, west, 0.0), post(ellipsoid, near, west + step, 0.0),
                                             post(ellipsoid, far, west + step, 0.0)};
        EXPECT_LE(sagOfFinerMeshes(ellipsoid, tile.bin(), true), 1.4 * dipOf(ellipsoid, cell, 0.0));
    }
}

// The deepest point, below the edge's posts, of a chord from `edge` towards `inner` up to where it is `run` inside.
double dipWithinRun(const Ellipsoid& ellipsoid, double edge, double inner, double run, double height, double relief) {
    const RealVector p = post(ellipsoid, edge, 0.0, height);
    const RealVector q = post(ellipsoid, inner, 0.0, height - relief);
    Real before = 0;
    Real after = 1;
    for (int i = 0; i < 50; ++i) {
        const Real share = (before + after) / 2;
        const Real inside = std::abs(test::ecefToGeodetic(ellipsoid, mixed(p, q, share)).latitude - Real{edge});
        (inside < run ? before : after) = share;
    }
    return height - altitudeOf(ellipsoid, mixed(p, q, before));
}

// Oracle: along a meridian, the chord between the edge and a lower post of the row behind it.
TEST(CrackBounds, WhatIsBehindAnEdgeDipsNoDeeperThanTheBound) {
    for (const Ellipsoid& ellipsoid : ellipsoids()) {
        for (const double height : {-0.06 * smaller(ellipsoid), 0.0, 0.08 * smaller(ellipsoid)}) {
            const double relief = 3e-4 * smaller(ellipsoid);
            for (const double width : {0.02, 0.1, 0.4}) {
                for (const double south : {-1.2, -0.6, 0.1, 0.7, 1.1}) {
                    const GeodeticBin tile({south, south + width}, {0.3, 0.3 + width}, {height - relief, height});
                    const double cell = width / kFewestCells;
                    const double bound = dipBehindEdge(ellipsoid, tile, {width, width, width, width, {}}, relief);
                    for (const double edge : {south, south + width}) {
                        const RealVector middle =
                            mixed(post(ellipsoid, edge, 0.0, height), post(ellipsoid, edge, cell, height), Real(0.5L));
                        const Real poleward = test::ecefToGeodetic(ellipsoid, middle).latitude;
                        const double run = static_cast<double>(std::abs(poleward - Real{edge}));
                        for (const double inner : {edge - cell, edge + cell}) {
                            EXPECT_LE(dipWithinRun(ellipsoid, edge, inner, run, height, relief),
                                      bound + roundingOn(ellipsoid))
                                << width << " at " << edge << " on " << ellipsoid.equatorialRadius();
                        }
                    }
                }
            }
        }
    }
    const Ellipsoid sphere(6371000.0, 6371000.0);
    const GeodeticBin flat({0.5, 0.6}, {0.3, 0.4}, {0.0, 0.0});
    const TileEdges edges{0.1, 0.1, 0.1, 0.1, {}};
    EXPECT_LT(dipBehindEdge(sphere, flat, edges, 0.0), 3.0);
    EXPECT_LT(dipBehindEdge(sphere, flat, edges, 20000.0), 30.0);
}

}  // namespace
}  // namespace osgAnalyticBin::core::cracks

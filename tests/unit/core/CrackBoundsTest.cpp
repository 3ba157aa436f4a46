// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What cracks between tiles can show, and how deep meshes that are finer than a tile dip below their posts. Oracle:
// points of chords and triangles in long double, of every neighbour that a tile of a quadtree can have.

#include "CrackSamples.h"

namespace osgAnalyticBin::core::cracks {
namespace {

TEST(CrackBounds, ArcsSagNoMoreAndNearlyAsMuch) {
    Random random(1701);
    for (const Ellipsoid& ellipsoid : ellipsoids()) {
        double most = 0.0;
        for (int trial = 0; trial < 1000; ++trial) {
            const double angle = random.logUniform(1e-3, 1.0);
            const Heights heights(ellipsoid, random);
            const bool isMeridian = random.chance(0.5);
            // where curvature is least: the poles, or the equator
            const double middle = random.chance(0.3) ? random.pick(std::array<double, 2>{0.0, 0.5 * (kPi - angle)})
                                                     : random.uniform(-0.5, 0.5) * (kPi - angle);
            const double half = isMeridian ? 0.5 * angle : std::min(0.5 * angle / std::cos(middle), 1.5);
            const RealVector p = isMeridian ? post(ellipsoid, middle - half, 0.0, heights.next())
                                            : post(ellipsoid, middle, -half, heights.next());
            const RealVector q = isMeridian ? post(ellipsoid, middle + half, 0.0, heights.next())
                                            : post(ellipsoid, middle, half, heights.next());
            const double bound = sagOfArc(ellipsoid, angle);
            for (int i = 1; i < 16; ++i) {
                const double sag = heights.lowest() - altitudeOf(ellipsoid, mixed(p, q, Real(i) / 16));
                ASSERT_LE(sag, bound) << "angle " << angle << " at " << middle;
                most = std::max(most, sag / bound);
            }
        }
        EXPECT_GT(most, 0.93);
    }
    EXPECT_EQ(sagOfArc(kEarth, 0.0), 0.0);
    EXPECT_LT(sagOfArc(kEarth, 7.0), 2e7);
}

TEST(CrackBounds, EdgesAreThoseOfTheCoarsestTileOnTheLine) {
    Random random(1702);
    for (int trial = 0; trial < 5000; ++trial) {
        const Tile tile = Tile::random(random, 0, 10);
        const double most = random.chance(0.5) ? 0.0 : 0.02;
        const TileEdges edges = edgesOf(tile, [&](const Tile&) { return random.uniform(0.0, most); });
        const std::array<double, 4> found{edges.south, edges.east, edges.north, edges.west};
        for (const Edge edge : {South, East, North, West}) {
            const Tile coarsest = coarsestOnLine(tile, edge);
            const double expected = edge == South || edge == North ? coarsest.width() : coarsest.height();
            EXPECT_GE(found[edge], expected * (1.0 - 1e-12)) << tile.level << " " << tile.x << " " << tile.y;
            EXPECT_LE(found[edge], expected * (1.0 + 2.0 * most + 1e-12))
                << tile.level << " " << tile.x << " " << tile.y;
        }
    }
}

TEST(CrackBounds, EdgesFollowATileAcrossTheDateLine) {
    const GeodeticBin parent = GeodeticBin::fromDegrees({0.0, 20.0}, {170.0, 190.0}, {0.0, 0.0});
    const TileEdges parentEdges{0.5, 0.6, 0.7, 0.8, {}};
    // the same quarter, a turn away
    const GeodeticBin child = GeodeticBin::fromDegrees({10.0, 20.0}, {-180.0, -170.0}, {0.0, 0.0});
    const TileEdges edges = TileEdges::of(child, &parent, &parentEdges);
    const double width = 10.0 * kPi / 180.0;
    EXPECT_NEAR(edges.south, width, 1e-14);
    EXPECT_NEAR(edges.west, width, 1e-14);
    EXPECT_DOUBLE_EQ(edges.north, 0.7);
    EXPECT_DOUBLE_EQ(edges.east, 0.6);
}

TEST(CrackBounds, EdgesBeyondThoseOfTheTileAboveAreOnTheBorderWhereTheseAre) {
    const GeodeticBin parent = GeodeticBin::fromDegrees({0.0, 20.0}, {0.0, 20.0}, {0.0, 0.0});
    const TileEdges parentEdges{0.5, 0.6, 0.7, 0.8, {true, true, false, true}};
    const GeodeticBin child = GeodeticBin::fromDegrees({-10.0, 30.0}, {10.0, 35.0}, {0.0, 0.0});
    const TileEdges edges = TileEdges::of(child, &parent, &parentEdges);
    EXPECT_TRUE(edges.border.south);
    EXPECT_TRUE(edges.border.east);
    EXPECT_FALSE(edges.border.north);
    EXPECT_FALSE(edges.border.west);
}

// What a tile's neighbours of one level draw along its edges, as far as the tile goes.
class NeighbourSamples {
public:
    NeighbourSamples(const Ellipsoid& ellipsoid, const Interval& lowest, const Tile& tile, Random& random)
        : _ellipsoid(ellipsoid), _lowest(lowest), _tile(tile), _random(random) {}

    // Metres below their posts.
    [[nodiscard]] double dip() const { return _dip; }
    // Radians beyond the southern and the northern edge.
    [[nodiscard]] double run(Edge edge) const { return edge == South ? _southRun : _northRun; }

    void alongMeridian(const Tile& coarse, int cells) {
        const Heights heights(_ellipsoid, _lowest, _random, cells == kFewestCells);
        const double step = coarse.height() / cells;
        for (int i = 0; i < cells; ++i) {
            const double south = coarse.south() + i * step;
            if (south + step < _tile.south() || south > _tile.south() + _tile.height()) continue;
            const RealVector p = post(_ellipsoid, south, 0.0, heights.next());
            const RealVector q = post(_ellipsoid, south + step, 0.0, heights.next());
            for (int k = 1; k < 8; ++k) note(heights, mixed(p, q, Real(k) / 8));
        }
    }

    // `coarse`: the tile of this side whose neighbour, its mirror image, is beyond the edge; `cells` along, `rows` up.
    void alongParallel(const Tile& coarse, Edge edge, int cells, int rows) {
        const double latitude = edge == South ? _tile.south() : _tile.south() + _tile.height();
        if (std::abs(latitude) > 0.5 * kPi - 1e-9) return;
        const double inner = latitude + (edge == South ? -1.0 : 1.0) * coarse.height() / rows;
        const Heights heights(_ellipsoid, _lowest, _random, cells == kFewestCells);
        const double step = coarse.width() / cells;
        const bool runsOverTile = (edge == South) == (latitude > 0.0);
        for (int i = 0; i < cells; ++i) {
            const double west = coarse.west() + i * step;
            if (west + step < _tile.west() || west > _tile.west() + _tile.width()) continue;
            const RealVector p = post(_ellipsoid, latitude, west, heights.next());
            const RealVector q = post(_ellipsoid, latitude, west + step, heights.next());
            const RealVector third = post(_ellipsoid, inner, west + (_random.chance(0.5) ? step : 0.0), heights.next());
            for (int k = 1; k < 8; ++k) {
                const RealVector edgePoint = mixed(p, q, Real(k) / 8);
                note(heights, edgePoint);
                if (std::abs(latitude) < 1e-9) continue;  // a chord of the equator stays there
                if (runsOverTile)
                    noteStrip(heights, edgePoint, third, latitude);
                else
                    noteRun(edgePoint, edge, latitude);
            }
        }
    }

private:
    void note(const Heights& heights, const RealVector& point) {
        _dip = std::max(_dip, heights.lowest() - altitudeOf(_ellipsoid, point));
    }

    void noteRun(const RealVector& point, Edge edge, double latitude) {
        const double found = static_cast<double>(test::ecefToGeodetic(_ellipsoid, point).latitude);
        double& run = edge == South ? _southRun : _northRun;
        run = std::max(run, std::abs(found) - std::abs(latitude));
    }

    // The neighbour's triangle from its edge, which is above the tile, back to the tile's edge.
    void noteStrip(const Heights& heights, const RealVector& edgePoint, const RealVector& third, double latitude) {
        Real before = 0;
        Real after = 0.2L;
        for (int i = 0; i < 40; ++i) {
            const Real share = (before + after) / 2;
            const Real found = test::ecefToGeodetic(_ellipsoid, mixed(edgePoint, third, share)).latitude;
            (std::abs(found) > std::abs(Real{latitude}) ? before : after) = share;
        }
        for (int k = 0; k <= 4; ++k) note(heights, mixed(edgePoint, third, before * k / 4));
    }

    const Ellipsoid& _ellipsoid;
    const Interval _lowest;
    const Tile _tile;
    Random& _random;
    double _dip = 0.0, _southRun = 0.0, _northRun = 0.0;
};

NeighbourSamples sampledNeighbours(const Ellipsoid& ellipsoid, const Interval& lowest, const Tile& tile,
                                   Random& random) {
    NeighbourSamples samples(ellipsoid, lowest, tile, random);
    for (const Edge edge : {South, East, North, West}) {
        const int coarsest = coarsestOnLine(tile, edge).level;
        for (Tile coarse = tile; coarse.level >= std::max(1, coarsest); coarse = coarse.parent()) {
            for (const int cells : {kFewestCells, randomCells(random)})
                if (edge == East || edge == West)
                    samples.alongMeridian(coarse, cells);
                else
                    samples.alongParallel(coarse, edge, cells, cells == kFewestCells ? cells : randomCells(random));
        }
    }
    return samples;
}

// `lowest`: of the posts, in smaller radii.
void expectCracksAreBounded(const Ellipsoid& ellipsoid, const Tile& tile, Random& random,
                            const Interval& lowest = Heights::kOnEarth) {
    const std::string name = std::to_string(tile.level) + " " + std::to_string(tile.x) + " " + std::to_string(tile.y) +
                             " on " + std::to_string(ellipsoid.equatorialRadius());
    const TileEdges edges = edgesOf(tile);
    const GeodeticBin bin = tile.bin().withAltitude(
        {lowest.lower * smaller(ellipsoid), (lowest.upper + Heights::kRelief) * smaller(ellipsoid)});
    const NeighbourSamples samples = sampledNeighbours(ellipsoid, lowest, tile, random);
    const double depth = crackDepth(ellipsoid, bin, edges);
    const double rounding = roundingOn(ellipsoid);
    EXPECT_LE(samples.dip(), depth + rounding) << name;
    // the largest radius of curvature counts everywhere, and that of the highest posts
    const double axes = larger(ellipsoid) / smaller(ellipsoid), room = 1.0 + lowest.width();
    EXPECT_LE(depth, 1.1 * room * axes * axes * axes * samples.dip() + rounding) << name;

    const GeodeticBin wide = withGaps(ellipsoid, bin, edges);
    const double south = bin.latitude().lower - wide.latitude().lower;
    const double north = wide.latitude().upper - bin.latitude().upper;
    EXPECT_EQ(wide.longitude(), bin.longitude());
    EXPECT_EQ(wide.altitude(), bin.altitude());
    EXPECT_LE(samples.run(South), south + 1e-15) << name;
    EXPECT_LE(samples.run(North), north + 1e-15) << name;
    // 1.1 of room, the square of the axes' ratio, and the same once more where posts are deep
    const double loose = std::max(1.6, 1.3 * axes * axes) * (1.0 + 4.0 * axes * lowest.width());
    EXPECT_LE(south, loose * samples.run(South) + 1e-15) << name;
    EXPECT_LE(north, loose * samples.run(North) + 1e-15) << name;

    // a mesh's own chords run poleward too
    const GeodeticBin grown =
        withGaps(ellipsoid, bin, {bin.longitude().width(), 0.0, bin.longitude().width(), 0.0, {}});
    EXPECT_LE(samples.dip(), crackDepth(ellipsoid, grown, edges) + rounding) << name;
}

// Small bodies have mountains a tenth of their radius high.
TEST(CrackBounds, NoCoarserNeighbourDipsDeeperOrRunsFarther) {
    constexpr Interval kMountains{-0.08, 0.08};
    Random random(1703);
    for (const Ellipsoid& ellipsoid : ellipsoids()) {
        for (int trial = 0; trial < 10; ++trial) {
            const Tile tile = Tile::random(random, 2, 10);
            expectCracksAreBounded(ellipsoid, tile, random, trial < 6 ? Heights::kOnEarth : kMountains);
        }
    }
}

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

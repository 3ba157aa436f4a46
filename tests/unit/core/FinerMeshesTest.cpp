// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How deep meshes that are finer than a tile dip below their posts. Oracle: points of chords and triangles in long
// double, of descendants of tiles of a quadtree as VirtualPlanetBuilder's: one tile over the whole globe, then two,
// then four to each.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::kFewestCells;

const Ellipsoid kEarth = wgs84();

// The earth first; in other units: PlanetMeshesTest.cpp.
const std::vector<Ellipsoid>& ellipsoids() {
    static const std::vector<Ellipsoid> all = [] {
        std::vector<Ellipsoid> list{kEarth, Ellipsoid(6371000.0, 6371000.0), Ellipsoid(6378137.0, 6420000.0)};
        for (const Planet& planet : kPlanets) list.push_back(planet.in(1.0));
        return list;
    }();
    return all;
}

// 10 micrometres on the earth.
double roundingOn(const Ellipsoid& ellipsoid) {
    return 1.6e-12 * larger(ellipsoid);
}

// A tile of the quadtree; columns count from 180 degrees west, rows from the south pole.
struct Tile {
    int level = 0;
    int x = 0;
    int y = 0;

    [[nodiscard]] int columns() const { return 1 << level; }
    [[nodiscard]] int rows() const { return level == 0 ? 1 : 1 << (level - 1); }
    [[nodiscard]] double width() const { return 2.0 * kPi / columns(); }
    [[nodiscard]] double height() const { return kPi / rows(); }
    [[nodiscard]] double west() const { return -kPi + x * width(); }
    [[nodiscard]] double south() const { return -0.5 * kPi + y * height(); }
    [[nodiscard]] GeodeticBin bin() const {
        return GeodeticBin({south(), south() + height()}, {west(), west() + width()}, {0.0, 0.0});
    }

    [[nodiscard]] static Tile random(Random& random, int coarsest, int finest) {
        Tile tile;
        tile.level = random.integer(coarsest, finest);
        tile.x = random.integer(0, tile.columns() - 1);
        tile.y = random.integer(0, tile.rows() - 1);
        // the date line and the poles often
        if (random.chance(0.2)) tile.x = random.chance(0.5) ? 0 : tile.columns() - 1;
        if (random.chance(0.2)) tile.y = random.chance(0.5) ? 0 : tile.rows() - 1;
        return tile;
    }
};

RealVector post(const Ellipsoid& ellipsoid, double latitude, double longitude, double altitude) {
    return geodeticToEcef(ellipsoid, Real{latitude}, Real{longitude}, Real{altitude});
}

RealVector mixed(const RealVector& p, const RealVector& q, Real share) {
    return (1 - share) * p + share * q;
}

double altitudeOf(const Ellipsoid& ellipsoid, const RealVector& point) {
    return static_cast<double>(ecefToGeodetic(ellipsoid, point).altitude);
}

// A number of cells that a mesh may have along an edge: the fewest, often.
int randomCells(Random& random) {
    return random.chance(0.5) ? kFewestCells : random.integer(kFewestCells, 70);
}

// Heights enter by their lowest: posts stand there, or higher by chance.
class Heights {
public:
    Heights(const Ellipsoid& ellipsoid, Random& random)
        : _random(random),
          _lowest(random.uniform(-11000.0, 9000.0) * smaller(ellipsoid) / kEarth.polarRadius()),
          _relief(random.chance(0.5) ? 0.0 : 3000.0 * smaller(ellipsoid) / kEarth.polarRadius()) {}

    [[nodiscard]] double lowest() const { return _lowest; }
    [[nodiscard]] double next() const { return _lowest + _relief * _random.uniform(); }

private:
    Random& _random;
    double _lowest, _relief;
};

TEST(FinerMeshes, ArcsSagNoMoreAndNearlyAsMuch) {
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

TEST(FinerMeshes, NoFinerGridDipsDeeper) {
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

TEST(FinerMeshes, NoFinerTriangleDipsDeeper) {
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

TEST(FinerMeshes, FinerMeshesNearlyDipAsDeep) {
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

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles of a quadtree with heights at random, on several planets: what the bounds of cracks are tried on. Quadtree: as
// VirtualPlanetBuilder's, one tile over the whole globe, then two, then four to each.

#pragma once

#include "CoreTest.h"

namespace osgAnalyticBin::core::cracks {

using test::Random;
using test::Real;
using test::RealVector;

inline constexpr double kPi = 3.14159265358979323846;

inline const Ellipsoid kEarth(6378137.0, 6356752.3142);

// The earth first; in other units: PlanetMeshesTest.cpp.
inline const std::vector<Ellipsoid>& ellipsoids() {
    static const std::vector<Ellipsoid> all = [] {
        std::vector<Ellipsoid> list{kEarth, Ellipsoid(6371000.0, 6371000.0), Ellipsoid(6378137.0, 6420000.0)};
        for (const test::Planet& planet : test::kPlanets) list.push_back(planet.in(1.0));
        return list;
    }();
    return all;
}

inline double smaller(const Ellipsoid& e) {
    return std::min(e.equatorialRadius(), e.polarRadius());
}

inline double larger(const Ellipsoid& e) {
    return std::max(e.equatorialRadius(), e.polarRadius());
}

// 10 micrometres on the earth.
inline double roundingOn(const Ellipsoid& ellipsoid) {
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
    [[nodiscard]] Tile parent() const { return {level - 1, x / 2, level == 1 ? 0 : y / 2}; }

    // Larger than its cell by a part of its size on each side.
    [[nodiscard]] GeodeticBin bin(double excess = 0.0) const {
        const double dx = excess * width();
        const double dy = excess * height();
        return GeodeticBin({south() - dy, south() + height() + dy}, {west() - dx, west() + width() + dx}, {0.0, 0.0});
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

template <class Excess>
inline TileEdges edgesOf(const Tile& tile, const Excess& excess) {
    if (tile.level == 0) return TileEdges::of(tile.bin(), nullptr, nullptr);
    const Tile parent = tile.parent();
    const TileEdges parentEdges = edgesOf(parent, excess);
    const GeodeticBin parentBin = parent.bin(excess(parent));
    return TileEdges::of(tile.bin(excess(tile)), &parentBin, &parentEdges);
}

inline TileEdges edgesOf(const Tile& tile) {
    return edgesOf(tile, [](const Tile&) { return 0.0; });
}

enum Edge { South, East, North, West };

// The coarsest ancestor, the tile itself included, with an edge on the same line, by whole numbers.
inline Tile coarsestOnLine(const Tile& tile, Edge edge) {
    Tile coarsest = tile;
    Tile at = tile;
    while (at.level > 0) {
        const Tile parent = at.parent();
        const int split = at.level == 1 ? 1 : 2;
        const bool shares = edge == South   ? at.y == split * parent.y
                            : edge == North ? at.y + 1 == split * (parent.y + 1)
                            : edge == West  ? at.x == 2 * parent.x
                                            : at.x + 1 == 2 * (parent.x + 1);
        if (!shares) break;
        coarsest = parent;
        at = parent;
    }
    return coarsest;
}

inline RealVector post(const Ellipsoid& ellipsoid, double latitude, double longitude, double altitude) {
    return test::geodeticToEcef(ellipsoid, Real{latitude}, Real{longitude}, Real{altitude});
}

inline RealVector mixed(const RealVector& p, const RealVector& q, Real share) {
    return (1 - share) * p + share * q;
}

inline double altitudeOf(const Ellipsoid& ellipsoid, const RealVector& point) {
    return static_cast<double>(test::ecefToGeodetic(ellipsoid, point).altitude);
}

// A number of cells that a mesh may have along an edge: the fewest, often.
inline int randomCells(Random& random) {
    return random.chance(0.5) ? kFewestCells : random.integer(kFewestCells, 70);
}

// Heights enter by their lowest: posts stand there, or higher by chance.
class Heights {
public:
    Heights(const Ellipsoid& ellipsoid, Random& random) : Heights(ellipsoid, random, random.chance(0.5)) {}
    Heights(const Ellipsoid& ellipsoid, Random& random, bool isFlat) : Heights(ellipsoid, kOnEarth, random, isFlat) {}
    // The lowest posts are in a range, in smaller radii.
    Heights(const Ellipsoid& ellipsoid, const Interval& lowest, Random& random, bool isFlat)
        : _random(random),
          _lowest(random.uniform(lowest.lower, lowest.upper) * smaller(ellipsoid)),
          _relief(isFlat ? 0.0 : kRelief * smaller(ellipsoid)) {}

    static constexpr Interval kOnEarth{-11000.0 / 6356752.0, 9000.0 / 6356752.0};
    static constexpr double kRelief = 3000.0 / 6356752.0;

    [[nodiscard]] double lowest() const { return _lowest; }
    [[nodiscard]] double next() const { return _lowest + _relief * _random.uniform(); }

private:
    Random& _random;
    double _lowest, _relief;
};

}  // namespace osgAnalyticBin::core::cracks

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: positions in long double of random points of all triangles, skirts included.

#include "CoreTest.h"
#include "MeshSamples.h"

#include <tuple>

namespace osgAnalyticBin::test {
namespace {

// A tile of the globe, of some hundred metres to some hundred kilometres, with its posts at random altitudes.
struct Tile {
    explicit Tile(Random& random) : ellipsoid(random.chance(0.5) ? wgs84() : Ellipsoid(1e5, 1e5 * 1.004)) {
        const double size = random.logUniform(1e-5, 0.1), south = random.uniform(-1.4, 1.3);
        const double west = random.chance(0.2) ? kPi - 0.5 * size : random.uniform(-3.1, 3.0);
        relief = size * ellipsoid.equatorialRadius() * random.logUniform(1e-4, 0.1);
        extents = GeodeticBin({south, south + size}, {west, west + size}, {-relief, relief});
        cells = static_cast<std::uint32_t>(random.integer(2, 16));
        mesh = gridMesh(random, ellipsoid, extents, cells);
    }

    // A bin of all that is drawn, the borders of whose parts are as far beside as they may be.
    [[nodiscard]] GeodeticBin bin(Random& random, double depth) const {
        const auto wider = [&](const Interval& of) -> Interval {
            const double more = 0.0199 * of.width();
            if (random.chance(0.3)) return {of.lower - 1.5 * more, of.upper + 1.5 * more};
            return random.chance(0.5) ? Interval{of.lower - more, of.upper} : Interval{of.lower, of.upper + more};
        };
        return GeodeticBin(wider(extents.latitude()), wider(extents.longitude()), {-relief - depth, 2.0 * relief});
    }

    Ellipsoid ellipsoid;
    GeodeticBin extents{};
    double relief;
    std::uint32_t cells;
    EcefMesh mesh;
};

// Which of four equal strips of an interval a number is in.
std::size_t stripOf(const Interval& whole, Real at) {
    const double share = static_cast<double>((at - whole.lower) / whole.width());
    return static_cast<std::size_t>(std::clamp(std::floor(4.0 * share), 0.0, 3.0));
}

// Returns: how many tops are known.
int expectBelowTops(Random& random, const Tile& tile, const EcefMesh& drawn, const GroundPlates& plates, double depth) {
    const GeodeticBin bin = tile.bin(random, depth);
    for (std::size_t i = 0; i < drawn.triangles.size(); i += 3) {
        for (int trial = 0; trial < 4; ++trial) {
            const RealGeodetic at = ecefToGeodetic(tile.ellipsoid, randomPointOf(random, triangleAt(drawn, i)));
            const Real turns = std::round((at.longitude - bin.longitude().middle()) / (2 * kPi));
            const std::size_t row = stripOf(bin.latitude(), at.latitude);
            const std::size_t column = stripOf(bin.longitude(), at.longitude - turns * 2 * kPi);
            const std::size_t quarter = row / 2 * 2 + column / 2;
            const double top = plates.most(4 * quarter + row % 2 * 2 + column % 2, bin);
            EXPECT_LE(top, plates.mostOfQuarter(quarter, bin));
            EXPECT_LE(at.altitude, top) << "cells " << tile.cells << ", triangle " << i / 3;
            if (!(at.altitude <= top)) return 0;
        }
    }
    int known = 0;
    for (std::size_t part = 0; part < GroundPlates::kParts; ++part) known += std::isfinite(plates.most(part, bin));
    return known;
}

// Counts the known tops of many random tiles. `make(tile)` returns what is drawn, its plates and its skirts' depth.
template <class Make>
int knownTops(Random& random, int trials, const Make& make) {
    int known = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Tile tile(random);
        const std::tuple<EcefMesh, GroundPlates, double> made = make(tile);
        known += expectBelowTops(random, tile, std::get<0>(made), std::get<1>(made), std::get<2>(made));
    }
    return known;
}

TEST(GroundPlates, TopsAreAboveTheMesh) {
    Random random(1730);
    int closed = 0;
    const int known = knownTops(random, 500, [&](const Tile& tile) {
        EcefMesh mesh = tile.mesh;
        const double most = tile.extents.latitude().width() / tile.cells * 1e5 * random.logUniform(1e-7, 0.1);
        for (std::size_t i = random.chance(0.5) ? 0 : mesh.size(); i < mesh.size(); ++i)
            moveVertex(mesh, i, random.uniform(0.0, most) * random.direction());
        if (random.chance(0.3)) mesh = unmerged(mesh);
        const bool isClosed = !random.chance(0.3);
        if (!isClosed) std::swap(mesh.triangles[0], mesh.triangles[1]);
        closed += isClosed ? 1 : 0;
        return std::tuple(mesh, platesOf(tile.ellipsoid, mesh, tile.extents), 0.0);
    });
    EXPECT_GT(known, closed * 12);
}

TEST(GroundPlates, TopsAreAboveTheMeshOfAGrid) {
    Random random(1731);
    const auto make = [](const Tile& tile) {
        return std::tuple(tile.mesh, gridPlatesOf(tile.ellipsoid, tile.mesh, tile.extents, tile.cells), 0.0);
    };
    EXPECT_GT(knownTops(random, 500, make), 500 * 12);
}

// Skirts that hang or stand, as they are in the mesh.
TEST(GroundPlates, TopsAreAboveSkirts) {
    Random random(1732);
    const int known = knownTops(random, 500, [&](const Tile& tile) {
        const double depth = random.sign() * tile.relief * random.logUniform(0.01, 0.9);
        const EcefMesh mesh = withSkirts(tile.ellipsoid, tile.mesh, tile.cells, depth);
        return std::tuple(mesh, platesOf(tile.ellipsoid, mesh, tile.extents), std::abs(depth));
    });
    EXPECT_GT(known, 2000);
}

// Skirts hang down from post to post where they are drawn, some 2.5 degrees off the vertical. They are as deep as the
// tile is wide at most; tops are known for half of that.
TEST(GroundPlates, TopsAreAboveSkirtsOfAGrid) {
    Random random(1733);
    const int known = knownTops(random, 500, [&](const Tile& tile) {
        const double depth = tile.extents.latitude().width() * tile.ellipsoid.polarRadius() *
                             (random.chance(0.5) ? random.uniform(0.0, 1.0) : random.logUniform(0.001, 0.1));
        EcefMesh drawn = withSkirts(tile.ellipsoid, tile.mesh, tile.cells, depth);
        const glm::dvec3 aside = 0.044 * depth * random.direction();
        for (std::size_t i = tile.mesh.size(); i < drawn.size(); ++i) moveVertex(drawn, i, aside);
        return std::tuple(drawn, gridPlatesOf(tile.ellipsoid, tile.mesh, tile.extents, tile.cells, 0.0, depth), depth);
    });
    EXPECT_GT(known, 2000);
}

// A line counts by its ends, and may run through all parts.
TEST(GroundPlates, TopsAreAboveLines) {
    Random random(1734);
    const auto in = [&](const Interval& range) { return random.uniform(range.lower, range.upper); };
    const int known = knownTops(random, 300, [&](const Tile& tile) {
        EcefMesh mesh = tile.mesh;
        const auto first = static_cast<std::uint32_t>(mesh.size());
        for (const std::uint32_t end : {first, first + 1}) {
            addVertex(mesh, tile.ellipsoid.toEcef({in(tile.extents.latitude()), in(tile.extents.longitude()),
                                                   random.uniform(0.0, 2.0) * tile.relief}));
            mesh.triangles.insert(mesh.triangles.end(), {end, end, end});
        }
        EcefMesh drawn = mesh;
        drawn.triangles.insert(drawn.triangles.end(), {first, first + 1, first + 1});
        return std::tuple(drawn, platesOf(tile.ellipsoid, mesh, tile.extents), 0.0);
    });
    EXPECT_GT(known, 1200);
}

// The room is 0.06 of the width: one cell of 16 a side, and two of 20.
TEST(GroundPlates, TopsAreThoseOfTheHighestPostsNearThePart) {
    Random random(1735);
    const Ellipsoid earth = wgs84();
    for (int trial = 0; trial < 20; ++trial) {
        const std::uint32_t cells = trial % 2 == 0 ? 16 : 20, beyond = trial % 2 == 0 ? 1 : 2;
        const EcefMesh mesh = gridMesh(random, earth, kHills, cells);
        const GroundPlates plates = platesOf(earth, mesh, kHills);
        for (std::uint32_t part = 0; part < GroundPlates::kParts; ++part) {
            const std::uint32_t south = part / 8 * 2 + part / 2 % 2, west = part / 4 % 2 * 2 + part % 2;
            const auto first = [&](std::uint32_t strip) { return std::max(cells / 4 * strip, beyond) - beyond; };
            const auto last = [&](std::uint32_t strip) { return std::min(cells / 4 * (strip + 1) + beyond, cells); };
            double highest = -HUGE_VAL;
            for (std::uint32_t row = first(south); row <= last(south); ++row)
                for (std::uint32_t column = first(west); column <= last(west); ++column)
                    highest = std::max(highest, earth.toGeodetic(mesh.vertex(row * (cells + 1) + column)).altitude);
            EXPECT_NEAR(plates.most(part, kHills), highest, 1e-3 + 2.0 * 2300.0 / 65533.0);
        }
    }
}

TEST(GroundPlates, TopsAreNotKnownForBinsWithOtherParts) {
    Random random(1736);
    const GroundPlates plates = platesOf(wgs84(), gridMesh(random, wgs84(), kHills, 16), kHills);
    const auto isKnown = [&](const Interval& latitude, const Interval& longitude, const Interval& altitude) {
        return std::isfinite(plates.most(3, GeodeticBin(latitude, longitude, altitude)));
    };
    EXPECT_TRUE(isKnown({0.5, 0.51}, {1.0, 1.01}, {-300.0, 2000.0}));
    EXPECT_TRUE(isKnown({0.49972, 0.51028}, {1.0, 1.01018}, {-300.0, 2000.0}));
    EXPECT_TRUE(isKnown({0.50014, 0.51014}, {1.00028, 1.00972}, {-300.0, 2000.0}));
    EXPECT_FALSE(isKnown({0.49968, 0.51032}, {1.0, 1.01}, {-300.0, 2000.0}));
    EXPECT_FALSE(isKnown({0.5, 0.51}, {1.00032, 1.00968}, {-300.0, 2000.0}));
    EXPECT_FALSE(isKnown({0.5, 0.51022}, {1.0, 1.01}, {-300.0, 2000.0}));
    EXPECT_FALSE(isKnown({0.5, 0.51}, {1.00016, 1.01016}, {-300.0, 2000.0}));
    EXPECT_FALSE(std::isfinite(GroundPlates().most(0, kHills)));
}

// The tile is some 56 km wide, measured along a sphere that lies within the ellipsoid a little less.
TEST(GroundPlates, TopsAreNotKnownWhereSkirtsAreTooDeep) {
    const core::GeodeticGrid grid{kHills.latitude(), kHills.longitude(), 17, 17};
    const std::vector<double> altitudes(17 * 17, 100.0);
    for (const auto& [depth, isKnown] : {std::pair{22e3, true}, std::pair{29e3, false}, std::pair{-1.0, false}})
        EXPECT_EQ(std::isfinite(GroundPlates(wgs84(), grid, altitudes, 0.0, depth).most(0, kHills)), isKnown);
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Floors of bins in ragged trees with random heights. Oracle: which edges meet, in whole numbers; any tile may be drawn
// beside any other that is neither above nor below it.

#include <gtest/gtest.h>

#include <algorithm>
#include <index/CrackFloor.h>
#include <index/Neighbours.h>
#include <memory>
#include <support/Random.h>

namespace osgAnalyticBin::indexing {
namespace {

using core::GeodeticBin;
using test::Random;

constexpr int kDeepest = 3;

// Column and row of a quadtree of 4 x 2 tiles of 90 degrees at depth 0.
struct Place {
    int depth, column, row;

    [[nodiscard]] int size() const { return 1 << (kDeepest - depth); }
    [[nodiscard]] int west() const { return column * size(); }
    [[nodiscard]] int south() const { return row * size(); }
    [[nodiscard]] double degrees() const { return 90.0 / (1 << depth); }
};

constexpr int kColumns = 4 << kDeepest;

struct Forest {
    std::vector<Place> places;
    std::vector<std::unique_ptr<TileRecord>> records;
    std::vector<TreeTile> tiles;

    void add(Random& random, const Place& place, int parent = -1, double childChance = 0.0) {
        const auto index = static_cast<int>(tiles.size());
        places.push_back(place);
        records.push_back(recordAt(random, place));
        TreeTile tile;
        tile.record = records.back().get();
        tile.depth = static_cast<std::uint32_t>(place.depth);
        if (parent >= 0) tile.parents.push_back(static_cast<std::uint32_t>(parent));
        tile.united = tile.record->surface.bin;
        tile.skirt = tile.record->surface.skirt;
        tile.skirtLow = tile.united.bin().altitude().lower - tile.skirt;
        tiles.push_back(tile);
        if (place.depth == kDeepest || !random.chance(childChance)) return;
        for (int i = 0; i < 4; ++i)
            add(random, {place.depth + 1, 2 * place.column + i % 2, 2 * place.row + i / 2}, index, childChance);
    }

    void unite() {
        for (std::size_t i = tiles.size(); i-- > 0;) {
            for (const std::uint32_t parent : tiles[i].parents) {
                tiles[parent].united.expandBy(tiles[i].united);
                tiles[parent].skirtLow = std::min(tiles[parent].skirtLow, tiles[i].skirtLow);
                tiles[parent].skirt = std::max(tiles[parent].skirt, tiles[i].skirt);
            }
        }
    }

    static std::unique_ptr<TileRecord> recordAt(Random& random, const Place& place) {
        auto record = std::make_unique<TileRecord>();
        const double low = random.uniform(-5000.0, 3000.0);
        const double south = -90.0 + place.row * place.degrees();
        const double west = -180.0 + place.column * place.degrees();
        // chords bulge over the edge that is nearer to the pole
        const double bulge = random.uniform(0.0, 0.02) * place.degrees();
        const core::Interval latitude{south - (south < 0.0 ? bulge : 0.0),
                                      south + place.degrees() + (south < 0.0 ? 0.0 : bulge)};
        record->surface.bin =
            AnalyticBin(GeodeticBin::fromDegrees(latitude, {west, west + place.degrees()}, {low, low + 4000.0}), 0.1);
        for (double& edge : record->surface.edgeLow) edge = low + random.uniform(0.0, 2000.0);
        record->surface.skirt = random.chance(0.2) ? 0.0 : random.logUniform(10.0, 20000.0);
        return record;
    }
};

Forest randomForest(std::uint64_t stream) {
    Random random(stream);
    Forest forest;
    const double childChance = random.uniform(0.2, 0.9);
    for (int i = 0; i < 8; ++i) forest.add(random, {0, i % 4, i / 4}, -1, childChance);
    forest.unite();
    return forest;
}

bool isBelow(const Place& a, const Place& b) {
    return a.depth >= b.depth && a.column >> (a.depth - b.depth) == b.column && a.row >> (a.depth - b.depth) == b.row;
}

bool overlaps(int a, int aSize, int b, int bSize) {
    return a < b + bSize && b < a + aSize;
}

/// The edge of `b` that lies on an edge of `a`: south, east, north, west; -1: none.
int edgeBeside(const Place& a, const Place& b) {
    if (overlaps(a.west(), a.size(), b.west(), b.size())) {
        if (a.south() + a.size() == b.south()) return 0;
        if (b.south() + b.size() == a.south()) return 2;
    }
    if (overlaps(a.south(), a.size(), b.south(), b.size())) {
        if ((b.west() + b.size()) % kColumns == a.west()) return 1;
        if ((a.west() + a.size()) % kColumns == b.west()) return 3;
    }
    return -1;
}

TEST(CrackFloor, NoNeighbourShowsMoreOfASkirt) {
    int raised = 0;
    for (std::uint64_t stream = 500; stream < 520; ++stream) {
        const Forest forest = randomForest(stream);
        const std::vector<AnalyticBin> bins = binsWithCracks(forest.tiles);
        ASSERT_EQ(bins.size(), forest.tiles.size());
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const double low = bins[i].bin().altitude().lower;
            const double endOfSkirts = forest.tiles[i].skirtLow;
            ASSERT_GE(low, endOfSkirts);
            ASSERT_TRUE(bins[i].contains(forest.tiles[i].united));
            raised += low > endOfSkirts ? 1 : 0;
            const double endOfOwn =
                forest.records[i]->surface.bin.bin().altitude().lower - forest.records[i]->surface.skirt;
            for (std::size_t k = 0; k < bins.size(); ++k) {
                if (isBelow(forest.places[i], forest.places[k]) || isBelow(forest.places[k], forest.places[i]))
                    continue;
                const int edge = edgeBeside(forest.places[i], forest.places[k]);
                if (edge < 0) continue;
                const double shown = forest.records[k]->surface.edgeLow[static_cast<std::size_t>(edge)];
                ASSERT_LE(low, std::max(shown, endOfOwn)) << stream << ' ' << i << ' ' << k;
            }
        }
    }
    EXPECT_GT(raised, 1000);
}

TEST(CrackFloor, IsAtTheWholeSkirtWhereAnythingMayBeBesideAndNowhereWithoutSkirts) {
    Random random(601);
    Forest patch;
    patch.add(random, {0, 1, 1});
    patch.unite();
    EXPECT_EQ(binsWithCracks(patch.tiles)[0].bin().altitude().lower, patch.tiles[0].skirtLow) << "at the rim";
    Forest forest = randomForest(603);
    forest.tiles[0].isKnown = false;
    const std::vector<AnalyticBin> bins = binsWithCracks(forest.tiles);
    EXPECT_FALSE(bins[0].valid());
    for (std::size_t i = 1; i < bins.size(); ++i) {
        if (forest.places[i].depth > 0 || edgeBeside(forest.places[0], forest.places[i]) < 0) continue;
        EXPECT_EQ(bins[i].bin().altitude().lower, forest.tiles[i].skirtLow) << "beside an unknown tile";
    }
    Forest bare = randomForest(600);
    for (TreeTile& tile : bare.tiles) {
        tile.skirt = 0.0;
        tile.skirtLow = tile.united.bin().altitude().lower;
    }
    const std::vector<AnalyticBin> ofBare = binsWithCracks(bare.tiles);
    for (std::size_t i = 0; i < ofBare.size(); ++i) EXPECT_EQ(ofBare[i], bare.tiles[i].united);
}

// Each file pages the next below both of its tiles: the ways up are as many as two to the depth.
TEST(CrackFloor, AncestorsAreMetOnceByHoweverManyWays) {
    constexpr std::uint32_t kDepth = 300;
    Random random(605);
    Forest forest;
    for (std::uint32_t depth = 0; depth < kDepth; ++depth) {
        for (int column = 0; column < 2; ++column) {
            forest.add(random, {0, column, 1});
            forest.tiles.back().depth = depth;
            if (depth > 0) forest.tiles.back().parents = {2 * depth - 2, 2 * depth - 1};
        }
    }
    forest.unite();
    std::size_t comparisons = 0;
    const std::vector<AnalyticBin> bins = binsWithCracks(forest.tiles, &comparisons);
    EXPECT_LE(comparisons, std::size_t{2 * kDepth} * 2 * kDepth * 4);
    for (std::size_t i = 0; i < bins.size(); ++i) ASSERT_TRUE(bins[i].contains(forest.tiles[i].united)) << i;
}

}  // namespace
}  // namespace osgAnalyticBin::indexing

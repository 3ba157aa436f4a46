// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgbinconv puts into an index, for databases of four makes. Oracle: samples of the triangles that OpenSceneGraph
// draws, tile by tile.

#include "BinconvRuns.h"
#include "DrawnDatabase.h"
#include "TestDatabases.h"

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>

#include <TileFixture.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

constexpr double kTwoPi = 6.28318530717958647693;

class Index : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (!isAtHand(GetParam())) GTEST_SKIP() << GetParam() << " is not there";
        _database = makeDatabase(GetParam(), _folder);
        ASSERT_FALSE(_database.empty());
        EXPECT_EQ(runIndex(_database).text, "");
        _index = indexOf(_database);
        _tiles = readAllTiles(_database);
        ASSERT_FALSE(_tiles.empty());
    }

    [[nodiscard]] const BinIndex::Entry& entryOf(const DrawnTile& tile) const {
        const BinIndex::Entry* entry = _index->find(tile.file, tile.ordinal);
        static const BinIndex::Entry kNone;
        EXPECT_TRUE(entry) << tile.file;
        return entry ? *entry : kNone;
    }

    void expectKnowsEveryTileAndNoOther() const;
    void expectEachEntryHoldsWhatItsTileAndAllDescendantsDraw() const;
    void expectEntriesHoldThoseOfTheirDescendants() const;
    void expectEntriesAreNoHigherThanTheHighestDescendantAndNoDeeperThanSkirts() const;
    void expectNoCrackShowsASkirtBelowItsTilesEntry() const;
    void expectSkirtsHardlyDeepenThem() const;

    TemporaryFolder _folder;
    std::string _database;
    osg::ref_ptr<BinIndex> _index;
    std::vector<DrawnTile> _tiles;
};

// Whether a position is on the footprint of a bin, its rim included; longitudes modulo a turn.
bool isOnFootprint(const core::GeodeticBin& bin, const core::Geodetic& position) {
    constexpr double kRim = 1e-9;
    const double offset = position.longitude - bin.longitude().lower;
    const double east = offset - kTwoPi * std::floor((offset + kRim) / kTwoPi);
    return east <= bin.longitude().width() + kRim && position.latitude >= bin.latitude().lower - kRim &&
           position.latitude <= bin.latitude().upper + kRim;
}

void Index::expectKnowsEveryTileAndNoOther() const {
    EXPECT_EQ(_index->tileCount(), _tiles.size());
    for (const DrawnTile& tile : _tiles) {
        EXPECT_EQ(entryOf(tile).fingerprint, tile.fingerprint) << tile.file;
        EXPECT_NE(tile.fingerprint, 0u);
        EXPECT_TRUE(entryOf(tile).bin.valid());
        EXPECT_LE(entryOf(tile).ownLow, tile.low);
        EXPECT_GT(entryOf(tile).ownLow, tile.low - 0.1);
    }
    EXPECT_EQ(_index->source().name, std::filesystem::path(_database).filename());
    EXPECT_EQ(_index->source().size, std::filesystem::file_size(_database));
}

void Index::expectEachEntryHoldsWhatItsTileAndAllDescendantsDraw() const {
    for (const DrawnTile& tile : _tiles) {
        ASSERT_FALSE(tile.samples.empty());
        std::vector<std::size_t> line = tile.ancestors;
        line.insert(line.begin(), static_cast<std::size_t>(&tile - _tiles.data()));
        for (const std::size_t above : line) {
            const AnalyticBin& bin = entryOf(_tiles[above]).bin;
            ASSERT_LE(metresOutside(bin, tile.samples, ellipsoidOfTests()), bin.margin())
                << tile.file << " in " << _tiles[above].file;
        }
    }
}

void Index::expectEntriesHoldThoseOfTheirDescendants() const {
    for (const DrawnTile& tile : _tiles) {
        for (const std::size_t above : tile.ancestors) {
            EXPECT_TRUE(entryOf(_tiles[above]).bin.contains(entryOf(tile).bin)) << tile.file;
        }
    }
}

void Index::expectEntriesAreNoHigherThanTheHighestDescendantAndNoDeeperThanSkirts() const {
    std::vector<double> high, low, skirt;
    for (const DrawnTile& tile : _tiles) {
        high.push_back(tile.high);
        low.push_back(tile.low - tile.skirt);
    }
    for (const DrawnTile& tile : _tiles) {
        for (const std::size_t above : tile.ancestors) {
            high[above] = std::max(high[above], tile.high);
            low[above] = std::min(low[above], tile.low - tile.skirt);
        }
    }
    for (std::size_t i = 0; i < _tiles.size(); ++i) {
        const core::Interval& altitude = entryOf(_tiles[i]).bin.bin().altitude();
        EXPECT_LT(altitude.upper, high[i] + 0.1) << _tiles[i].file;
        EXPECT_GT(altitude.lower, low[i] - 0.1) << _tiles[i].file;
    }
}

// An eye above sees a skirt through the crack at a neighbour's edge, above the neighbour's surface there.
void Index::expectNoCrackShowsASkirtBelowItsTilesEntry() const {
    std::size_t cracks = 0;
    for (std::size_t i = 0; i < _tiles.size(); ++i) {
        const AnalyticBin& bin = entryOf(_tiles[i]).bin;
        const double endOfSkirt = _tiles[i].low - _tiles[i].skirt;
        for (std::size_t k = 0; k < _tiles.size(); ++k) {
            if (i == k || _tiles[i].isAbove(i, _tiles[k]) || _tiles[k].isAbove(k, _tiles[i])) continue;
            for (const core::Geodetic& edge : _tiles[k].edgeSamples) {
                if (!isOnFootprint(bin.bin(), edge)) continue;
                ++cracks;
                ASSERT_LE(bin.bin().altitude().lower, std::max(edge.altitude, endOfSkirt) + bin.margin())
                    << _tiles[i].file << ' ' << _tiles[i].ordinal << " beside " << _tiles[k].file;
            }
        }
    }
    EXPECT_GT(cracks, 100u);
}

// Cracks show little of the skirts of a whole globe: the entries stay far above their ends.
void Index::expectSkirtsHardlyDeepenThem() const {
    double withSkirts = 0.0;
    double deepened = 0.0;
    for (const DrawnTile& tile : _tiles) {
        withSkirts += tile.skirt;
        deepened += tile.low - entryOf(tile).bin.bin().altitude().lower;
    }
    EXPECT_LT(deepened, 0.2 * withSkirts);
}

TEST_P(Index, HoldsWhatItsDatabaseDrawsAndLittleElse) {
    expectKnowsEveryTileAndNoOther();
    expectEachEntryHoldsWhatItsTileAndAllDescendantsDraw();
    expectEntriesHoldThoseOfTheirDescendants();
    expectEntriesAreNoHigherThanTheHighestDescendantAndNoDeeperThanSkirts();
    expectNoCrackShowsASkirtBelowItsTilesEntry();
    if (std::filesystem::exists(std::string(SAMPLE_DATA "/vpb/") + GetParam())) expectSkirtsHardlyDeepenThem();
}

INSTANTIATE_TEST_SUITE_P(Makes, Index, ::testing::Values("synthetic", "bindem", "terrain", "polygonal"),
                         [](const auto& suite) { return std::string(suite.param); });

}  // namespace
}  // namespace osgAnalyticBin::test

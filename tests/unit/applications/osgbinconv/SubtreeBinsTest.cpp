// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The bins of subtrees of files, against the union of all surfaces below each tile.

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <index/SubtreeBins.h>
#include <map>
#include <vector>

namespace osgAnalyticBin::indexing {
namespace {

using core::GeodeticBin;

// A file with one tile, and files below it.
FileRecord recordOf(const std::string& file, double low, double high, const std::vector<std::string>& below) {
    FileRecord record;
    record.file = file;
    record.isRead = true;
    TileRecord tile;
    tile.surface.bin = AnalyticBin(GeodeticBin({0.1, 0.2}, {0.1, 0.2}, {low, high}), 0.5);
    tile.surface.skirt = 30.0;
    tile.fingerprint = 7;
    record.tiles.push_back(tile);
    for (const std::string& name : below) record.links.push_back({name, 0, {}});
    return record;
}

using Published = std::map<std::string, std::vector<BinIndex::Entry>>;

Published publishedOf(const std::vector<FileRecord>& records) {
    Published published;
    SubtreeBins bins([&published](const std::string& file, std::vector<BinIndex::Entry> tiles) {
        EXPECT_EQ(published.count(file), 0u) << file;
        published[file] = std::move(tiles);
    });
    for (const FileRecord& record : records) bins.add(record);
    return published;
}

core::Interval altitudeOf(const Published& published, const std::string& file) {
    return published.at(file).at(0).bin.bin().altitude();
}

TEST(SubtreeBins, HoldAllBelowWithWholeSkirtsInWhateverOrderFilesAreRead) {
    std::vector<FileRecord> records{recordOf("", 0.0, 100.0, {"a", "b"}), recordOf("a", -50.0, 80.0, {"c"}),
                                    recordOf("b", 10.0, 300.0, {"c"}), recordOf("c", 20.0, 500.0, {})};
    for (int i = 0; i < 24; ++i) {
        const Published published = publishedOf(records);
        ASSERT_EQ(published.size(), 4u);
        EXPECT_EQ(altitudeOf(published, ""), (core::Interval{-80.0, 500.0}));
        EXPECT_EQ(altitudeOf(published, "a"), (core::Interval{-80.0, 500.0}));
        EXPECT_EQ(altitudeOf(published, "b"), (core::Interval{-20.0, 500.0}));
        EXPECT_EQ(altitudeOf(published, "c"), (core::Interval{-10.0, 500.0}));
        EXPECT_EQ(published.at("a")[0].fingerprint, 7u);
        EXPECT_EQ(published.at("a")[0].ownLow, -50.0);
        EXPECT_GE(published.at("a")[0].bin.sag(), 30.0);
        std::next_permutation(records.begin(), records.end(),
                              [](const FileRecord& a, const FileRecord& b) { return a.file < b.file; });
    }
}

TEST(SubtreeBins, WaitForAllFilesBelow) {
    const Published published =
        publishedOf({recordOf("", 0.0, 1.0, {"a", "b"}), recordOf("a", 0.0, 1.0, {}), recordOf("b", 0.0, 1.0, {"c"})});
    EXPECT_EQ(published.size(), 1u);
    EXPECT_EQ(published.count("a"), 1u);
}

TEST(SubtreeBins, AFileThatIsMissingMayHoldAnyTerrain) {
    FileRecord missing;
    missing.file = "a";
    const Published published = publishedOf({recordOf("", 0.0, 1.0, {"a"}), missing});
    EXPECT_LE(altitudeOf(published, "").lower, CullOptions::kTerrainOnEarth.lower);
    EXPECT_GE(altitudeOf(published, "").upper, CullOptions::kTerrainOnEarth.upper);
    EXPECT_EQ(published.count("a"), 0u);
}

TEST(SubtreeBins, WhatIsNotKnownBelowATileKeepsItVisible) {
    FileRecord unknown = recordOf("a", 0.0, 1.0, {});
    unknown.tiles[0].surface = TileSurface();
    EXPECT_FALSE(publishedOf({recordOf("", 0.0, 1.0, {"a"}), unknown}).at("")[0].bin.valid());
    FileRecord other = recordOf("a", 0.0, 1.0, {});
    other.hasOtherContent = true;
    const Published published = publishedOf({recordOf("", 0.0, 1.0, {"a"}), other});
    EXPECT_FALSE(published.at("")[0].bin.valid());
    EXPECT_TRUE(published.at("a")[0].bin.valid());
}

}  // namespace
}  // namespace osgAnalyticBin::indexing

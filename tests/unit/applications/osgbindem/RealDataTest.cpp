// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Real elevation data, where it is installed: known places, and the same checks as for synthetic rasters.

#include "DatabaseCheck.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

constexpr const char* kEtopo5 = "/usr/share/ferret-vis/data/etopo5.cdf";

std::string sample(const std::string& name) {
    return SAMPLE_DATA "/dem/" + name;
}

bool isThere(const std::string& path) {
    return std::filesystem::exists(path);
}

}  // namespace

TEST(RealData, Etopo5) {
    if (!isThere(kEtopo5)) GTEST_SKIP() << "package ferret-datasets is not installed";
    const LoadedDatabase database = databaseOf({kEtopo5, "--levels", "1", "--cells", "18"});
    const TestRaster raster(kEtopo5);
    checkDatabase(database, [&raster](const Rect& rect) { return raster.range(rect); });
    EXPECT_NEAR(database.altitudeAt(-90.0, 0.0), 2810.0, 0.3);
    // The Challenger Deep, in the tile at 135 .. 157.5 E, 0 .. 22.5 N, and all above it.
    EXPECT_LE(database.leafAt(11.3, 142.2).bin.bin().altitude().lower, -10376.0);
    EXPECT_LE(database.tiles[4 * 16 + 14].bin.bin().altitude().lower, -10376.0);
}

TEST(RealData, EverestWithVoids) {
    const std::string path = sample("everest_srtm3_N27E086.tif");
    if (!isThere(path)) GTEST_SKIP() << path << " is not there";
    const LoadedDatabase database = databaseOf({path, "--levels", "8", "-te", "86", "27", "87", "28"});
    checkSharedPosts(database);
    const TestRaster raster(path);
    database.forEach([&](const LoadedTile& tile) {
        const Range range = raster.range(tile.rect());
        if (range.lower > range.upper) return;
        EXPECT_GE(tile.bin.bin().altitude().upper, range.upper);
        EXPECT_GT(tile.bin.bin().altitude().lower, -3000.0) << "a void is no height";
    });
    EXPECT_GE(database.leafAt(27.988, 86.925).bin.bin().altitude().upper, 8642.0);
    EXPECT_LT(database.leafAt(27.988, 86.925).bin.bin().altitude().upper, 8650.0);
}

TEST(RealData, AleutiansPastTheDateLine) {
    const std::string path = sample("aleutians_etopo1_5min_antimeridian.tif");
    if (!isThere(path)) GTEST_SKIP() << path << " is not there";
    const LoadedDatabase database = databaseOf({path, "--levels", "2"});
    const TestRaster raster(path);
    checkSharedPosts(database);
    checkNodes(database);
    checkBins(database, [&raster](const Rect& rect) {
        Range range = raster.range(rect);
        if (rect.west < 165.0 && rect.east > -145.0) range.include(0.0);
        if (rect.south < 50.0 || rect.north > 65.0) range.include(0.0);
        return range;
    });
    EXPECT_NEAR(database.altitudeAt(56.25, 180.0), raster.height(56.25, 180.0), 0.3);
}

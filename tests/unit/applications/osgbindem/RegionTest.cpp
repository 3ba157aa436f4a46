// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Databases of a part of the earth (-te). The oracle is the database of the whole earth: where the region is, both have
// the same heights.

#include "DatabaseCheck.h"
#include "Program.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>

#include <set>

namespace {

class Region : public testing::Test {
protected:
    void SetUp() override {
        _globe.write(globe());
        _inset.write(inset());
    }

    [[nodiscard]] std::string globe() const { return _folder.file("globe.tif"); }
    [[nodiscard]] std::string inset() const { return _folder.file("inset.tif"); }
    [[nodiscard]] std::string file(const std::string& name) const { return _folder.file(name); }

    [[nodiscard]] LoadedDatabase built(const std::vector<std::string>& region) const {
        std::vector<std::string> words{globe(), inset(), "--cells", "24", "-o", file("earth.osgb"), "--overwrite"};
        words.insert(words.end(), region.begin(), region.end());
        build(words);
        return loadDatabase(file("earth.osgb"));
    }

    void expectRefused(const std::vector<std::string>& region) const {
        std::vector<std::string> words{globe(), "-o", file("refused.osgb"), "-te"};
        words.insert(words.end(), region.begin(), region.end());
        const Outcome outcome = run(words);
        EXPECT_NE(outcome.exitCode, 0);
        EXPECT_NE(outcome.errors.find("-te"), std::string::npos) << outcome.errors;
        EXPECT_EQ(outcome.errors.find('\n'), outcome.errors.size() - 1) << outcome.errors;
    }

private:
    const TempFolder _folder;
    const TestRaster _globe = TestRaster::globe(1.0, hills);
    const TestRaster _inset{10.0, 52.0, 0.04, 0.04, 76, 76, hills};
};

TEST_F(Region, HasTilesOnlyWhereTheyAreNeeded) {
    const LoadedDatabase whole = built({});
    const LoadedDatabase part = built({"-te", "11", "50", "12", "51"});
    EXPECT_LE(part.tiles.size(), 16U);
    int wanted = 0;
    int others = 0;
    part.forEach([&](const LoadedTile& tile) {
        const Rect rect = tile.rect();
        const bool isWanted = rect.west < 12.0 && rect.east > 11.0 && rect.south < 51.0 && rect.north > 50.0;
        EXPECT_TRUE(isWanted || tile.children.empty());
        ++(isWanted ? wanted : others);
    });
    EXPECT_LT(others, wanted);
    part.forEach([](const LoadedTile& tile) {
        for (const LoadedTile& child : tile.children) EXPECT_TRUE(tile.bin.contains(child.bin));
    });
    // Within the region it is as deep as the globe, and has the same heights.
    EXPECT_EQ(part.leafAt(50.5, 11.5).level, whole.leafAt(50.5, 11.5).level);
    for (double latitude = 50.1; latitude < 51.0; latitude += 0.2)
        for (double longitude = 11.1; longitude < 12.0; longitude += 0.2)
            EXPECT_NEAR(part.altitudeAt(latitude, longitude), whole.altitudeAt(latitude, longitude), 0.01);
    checkSharedPosts(part);
    checkNodes(part);
    // Given horizons are for whole globes: beside a region there is no ground that hides anything.
    const auto horizonOf = [](const LoadedDatabase& database) {
        const auto* callback =
            dynamic_cast<const osgAnalyticBin::InstallBinsCallback*>(database.root->getUpdateCallback());
        EXPECT_NE(callback, nullptr);
        return callback->getCullOptions().horizonUse;
    };
    EXPECT_EQ(horizonOf(whole), osgAnalyticBin::HorizonUse::Given);
    EXPECT_NE(horizonOf(part), osgAnalyticBin::HorizonUse::Given);
}

TEST_F(Region, PassesTheDateLine) {
    const LoadedDatabase part = built({"-te", "170", "-20", "190", "-10"});
    std::set<int> columns;
    for (const LoadedTile& tile : part.tiles) columns.insert(tile.x);
    EXPECT_EQ(columns.count(0), 1U);
    EXPECT_EQ(columns.count((16 << part.tiles.front().level) - 1), 1U);
    EXPECT_NEAR(part.altitudeAt(-15.0, 180.0), hills(-15.0, 180.0), 30.0);
    checkSharedPosts(part);
}

TEST_F(Region, IsUpdatedAsItIsBuiltAnew) {
    const std::vector<std::string> words{globe(), "--cells", "24", "-te", "11", "50", "12", "51"};
    const auto with = [&](std::vector<std::string> more, const std::string& folder) {
        std::filesystem::create_directory(file(folder));
        more.insert(more.begin(), words.begin(), words.end());
        more.insert(more.end(), {"-o", file(folder + "/earth.osgb")});
        build(more);
    };
    with({"--levels", "5"}, "old");
    with({"--levels", "5", inset(), "--update"}, "old");
    with({"--levels", "5", inset()}, "new");
    EXPECT_EQ(filesBelow(file("old")), filesBelow(file("new")));
}

TEST_F(Region, NoneOfTheEarthIsRefused) {
    expectRefused({"12", "50", "11", "51"});
    expectRefused({"11", "51", "12", "50"});
    expectRefused({"11", "50", "12", "91"});
    expectRefused({"11", "50", "nan", "51"});
    expectRefused({"11", "50", "12"});
    const Outcome outcome = run({inset(), "-o", file("refused.osgb"), "-te", "-100", "0", "-99", "1"});
    EXPECT_NE(outcome.errors.find("no raster has a part within -te"), std::string::npos) << outcome.errors;
}

}  // namespace

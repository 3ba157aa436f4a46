// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Databases that are updated where their rasters changed. Oracle: the database built anew from them, byte for byte.

#include "RasterTest.h"

namespace {

namespace fs = std::filesystem;

double bumps(double latitudeDeg, double longitudeDeg) {
    return 900.0 + hills(9.0 * latitudeDeg, 7.0 * longitudeDeg);
}

class Update : public RasterTest {
protected:
    void SetUp() override { setGlobe(2.0); }

    void setGlobe(double spacingDeg) const { (void)TestRaster::globe(spacingDeg, hills).write(file("globe.tif")); }
    std::string inset(double westDeg, double northDeg, double spacingDeg, int posts) {
        return saved(TestRaster(westDeg, northDeg, spacingDeg, posts, bumps));
    }
    [[nodiscard]] std::string root(const std::string& name) const { return file(name + "/earth.osgb"); }
    [[nodiscard]] Files files(const std::string& name) const { return filesBelow(file(name)); }

    /// The command line for a database in a folder of its own.
    [[nodiscard]] Words command(const std::string& name, const Words& words) const {
        (void)_folder.makeFolder(name);
        return joined({file("globe.tif"), "--cells", "6", "-o", root(name)}, words);
    }
    void built(const std::string& name, const Words& words) const {
        build(command(name, joined(words, {"--overwrite"})));
    }

    /// Updates the database "old" and builds the database "new" of the same rasters. Returns: the number of files that
    /// both databases have and that were written.
    int expectSame(const Words& words) const {
        const auto before = timesOfOld();
        build(command("old", joined(words, {"--update"})));
        built("new", words);
        const Files updatedFiles = files("old"), newFiles = files("new");
        EXPECT_EQ(updatedFiles.size(), newFiles.size());
        int written = 0;
        for (const auto& [name, time] : timesOfOld()) {
            const auto same = newFiles.find(name);
            EXPECT_TRUE(same != newFiles.end() && same->second == updatedFiles.at(name)) << name;
            const auto was = before.find(name);
            if (was != before.end() && was->second != time) ++written;
        }
        return written;
    }

private:
    [[nodiscard]] std::map<std::string, fs::file_time_type> timesOfOld() const {
        std::map<std::string, fs::file_time_type> times;
        for (const auto& [name, bytes] : files("old")) times[name] = fs::last_write_time(file("old/" + name));
        return times;
    }
};

TEST_F(Update, ASmallInsetIsAsIfItHadBeenThereFromTheBeginningAndFewFilesAreWritten) {
    setGlobe(1.0);
    built("old", {});
    const std::size_t before = files("old").size();
    ASSERT_GT(before, 600U);
    const int written = expectSame({inset(7.2, 46.9, 0.02, 51)});
    EXPECT_GT(written, 3);
    EXPECT_LE(8 * written, static_cast<int>(before)) << written << " of " << before;
    checkSharedPosts(loadDatabase(root("old")));
    checkNodes(loadDatabase(root("old")));
}

TEST_F(Update, InsetsAtPolesAndAcrossTheDateLine) {
    const std::string pole = inset(-30.0, 90.0, 0.1, 41);
    built("old", {});
    expectSame({pole});
    expectSame({inset(-181.0, -45.0, 0.08, 21), pole, inset(178.5, 0.8, 0.06, 61)});
}

TEST_F(Update, InsetsBesideAndWithinOthers) {
    Words rasters{inset(10.0, 50.0, 0.1, 31)};
    built("old", rasters);
    rasters.push_back(inset(13.0, 50.0, 0.1, 31));
    expectSame(rasters);
    // one within the first, one at the corner of four tiles
    expectSame(joined(rasters, {inset(11.0, 49.0, 0.02, 51), inset(33.75, 45.0, 0.04, 16)}));
}

TEST_F(Update, RastersThatAreReplacedOrTakenAway) {
    const Words rasters{inset(10.0, 50.0, 0.1, 31), inset(-70.0, -20.0, 0.04, 26)};
    built("old", rasters);
    (void)TestRaster(10.5, 50.0, 0.08, 21, hills).write(rasters.front());
    expectSame(rasters);
    expectSame({});
}

TEST_F(Update, ARegion) {
    setGlobe(1.0);
    const Words region{"--levels", "5", "-te", "11", "50", "12", "51"};
    built("old", region);
    expectSame(joined({saved(TestRaster(10.0, 52.0, 0.04, 76, hills))}, region));
}

TEST_F(Update, VoidsShowWhatHasChangedBelowThem) {
    TestRaster withVoid(10.0, 40.0, 0.02, 201, [](double latitudeDeg, double longitudeDeg) {
        const bool isVoid = std::abs(latitudeDeg - 38.0) < 0.9 && std::abs(longitudeDeg - 12.0) < 0.9;
        return isVoid ? std::nan("") : bumps(latitudeDeg, longitudeDeg);
    });
    const Words fine{saved(withVoid.withNodata(-9999.0)), "--levels", "4"};
    built("old", fine);
    EXPECT_GT(expectSame(joined({saved(TestRaster(10.5, 40.0, 0.1, 0.1, 12, 41, flat(3000.0)))}, fine)), 0);
    EXPECT_GT(expectSame(fine), 0);
}

TEST_F(Update, TilesOfAMapProjectionThatAreAddedAndReplaced) {
    const auto write = [this](const std::string& name, double x, double y, double lift) {
        TestRaster tile(x, y, 1000.0, 30, [=](double north, double east) {
            return 1000.0 + lift + 300.0 * std::sin(north / 4000.0) * std::cos(east / 3000.0);
        });
        return tile.in("EPSG:25833").write(file(name));
    };
    const Words first{write("first.tif", 600500.0, 6000500.0, 0.0), "--levels", "6"};
    const std::string beside = write("beside.tif", 630500.0, 6000500.0, 0.0);
    const std::string south = write("south.tif", 600500.0, 5970500.0, 0.0);
    built("old", first);
    expectSame(joined(first, {beside, south}));
    (void)write("beside.tif", 630500.0, 6000500.0, 100.0);
    expectSame(joined(first, {beside, south}));
    expectSame(joined(first, {south}));
}

TEST_F(Update, ImagesThatAreAddedReplacedOrTakenAway) {
    const std::string coarse = TestImage(0.0, 50.0, 0.5, 60, {20, 30, 200}).write(file("coarse.tif"));
    const std::string fine = TestImage(8.0, 50.0, 0.05, 60, {200, 30, 20}).write(file("fine.tif"));
    setGlobe(1.0);
    built("old", {"--levels", "2"});
    const int first = expectSame({"--levels", "2", "--image", coarse});
    const int second = expectSame({"--levels", "2", "--image", coarse, "--image", fine});
    EXPECT_GT(second, 1);
    EXPECT_LT(second, first) << first;
    EXPECT_LT(5 * first, static_cast<int>(files("old").size()));
    (void)TestImage(8.0, 50.0, 0.05, 60, {20, 200, 30}).write(fine);
    expectSame({"--levels", "2", "--image", fine});
}

TEST_F(Update, IsABuildWhereThereIsNoDatabase) {
    (void)_folder.makeFolder("old");
    EXPECT_EQ(expectSame({"--levels", "1"}), 0);
}

TEST_F(Update, NothingIsWrittenWhereNothingHasChanged) {
    built("old", {});
    const auto before = fs::last_write_time(root("old"));
    const Outcome outcome = run(command("old", {"--update"}));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.linesWith("nothing has changed"), 1) << outcome.text;
    EXPECT_EQ(fs::last_write_time(root("old")), before);
}

TEST_F(Update, OtherSettingsAndUnknownDatabasesAreRefused) {
    const auto expectRefused = [&](const Words& words, const std::string& what) {
        const Words all = command("old", joined(words, {"--update"}));
        const Files before = files("old");
        expectFailure(all, what);
        EXPECT_EQ(files("old"), before);
    };
    built("old", {});
    for (const Words& other : {Words{"--lod-factor", "6"}, {"--compress"}, {"--levels", "3"}})
        expectRefused(other, "other settings");
    fs::remove_all(file("old/earth_tiles/state"));
    expectRefused({}, "nobody knows");
}

}  // namespace

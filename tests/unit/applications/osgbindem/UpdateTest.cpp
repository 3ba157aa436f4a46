// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Databases that are updated where their rasters have changed. Oracle: the database built anew from the same rasters,
// byte for byte.

#include "DatabaseCheck.h"
#include "Program.h"
#include "TestImage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sys/stat.h>

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

double bumps(double latitudeDeg, double longitudeDeg) {
    return 900.0 + hills(9.0 * latitudeDeg, 7.0 * longitudeDeg);
}

TestRaster insetAt(double westDeg, double northDeg, double spacingDeg, int posts) {
    return {westDeg, northDeg, spacingDeg, spacingDeg, posts, posts, bumps};
}

class Update : public ::testing::Test {
protected:
    void SetUp() override { TestRaster::globe(2.0, hills).write(globe()); }

    [[nodiscard]] std::string globe() const { return folder.file("globe.tif"); }
    [[nodiscard]] std::string inset(const std::string& name) const { return folder.file(name + ".tif"); }
    [[nodiscard]] std::string root(const std::string& name) const { return folder.file(name + "/earth.osgb"); }

    /// The command line for a database in a folder of its own.
    [[nodiscard]] Words command(const std::string& name, Words words) const {
        fs::create_directories(folder.file(name));
        words.insert(words.begin(), {globe(), "--cells", "6"});
        words.insert(words.end(), {"-o", root(name)});
        return words;
    }
    void built(const std::string& name, Words words) const {
        words.push_back("--overwrite");
        build(command(name, words));
    }
    void updated(const std::string& name, Words words) const {
        words.push_back("--update");
        build(command(name, words));
    }
    [[nodiscard]] Files files(const std::string& name) const { return filesBelow(folder.file(name)); }

    /// Updates the database "old" and builds the database "new" of the same rasters. Returns: the number of files that
    /// both databases have and that were written.
    int expectSame(const Words& words) const {
        const std::map<std::string, ino_t> before = nodes("old");
        updated("old", words);
        built("new", words);
        const Files updatedFiles = files("old");
        const Files newFiles = files("new");
        EXPECT_EQ(namesOf(updatedFiles), namesOf(newFiles));
        int written = 0;
        const std::map<std::string, ino_t> after = nodes("old");
        for (const auto& [name, bytes] : updatedFiles) {
            const auto same = newFiles.find(name);
            EXPECT_TRUE(same != newFiles.end() && same->second == bytes) << name;
            const auto was = before.find(name);
            if (was != before.end() && was->second != after.at(name)) ++written;
        }
        return written;
    }

    const TempFolder folder;

private:
    [[nodiscard]] static Words namesOf(const Files& files) {
        Words names;
        for (const auto& file : files) names.push_back(file.first);
        return names;
    }
    [[nodiscard]] std::map<std::string, ino_t> nodes(const std::string& name) const {
        std::map<std::string, ino_t> result;
        for (const auto& file : files(name)) {
            struct stat status {};
            ::stat(folder.file(name + "/" + file.first).c_str(), &status);
            result[file.first] = status.st_ino;
        }
        return result;
    }
};

TEST_F(Update, AnInsetIsAsIfItHadBeenThereFromTheBeginning) {
    insetAt(10.3, 51.7, 0.04, 26).write(inset("alps"));
    built("old", {});
    expectSame({inset("alps")});
    checkSharedPosts(loadDatabase(root("old")));
    checkNodes(loadDatabase(root("old")));
}

TEST_F(Update, InsetsAtPolesAndAcrossTheDateLine) {
    insetAt(-30.0, 90.0, 0.1, 41).write(inset("pole"));
    insetAt(178.5, 0.8, 0.06, 61).write(inset("dateline"));
    insetAt(-181.0, -45.0, 0.08, 21).write(inset("south"));
    built("old", {});
    expectSame({inset("pole")});
    expectSame({inset("south"), inset("pole"), inset("dateline")});
}

TEST_F(Update, InsetsBesideAndWithinOthers) {
    insetAt(10.0, 50.0, 0.1, 31).write(inset("first"));
    insetAt(13.0, 50.0, 0.1, 31).write(inset("beside"));
    insetAt(11.0, 49.0, 0.02, 51).write(inset("within"));
    insetAt(33.75, 45.0, 0.04, 16).write(inset("corner"));  // at the corner of four tiles
    built("old", {inset("first")});
    expectSame({inset("first"), inset("beside")});
    expectSame({inset("first"), inset("beside"), inset("within"), inset("corner")});
}

TEST_F(Update, RastersThatAreReplacedOrTakenAway) {
    insetAt(10.0, 50.0, 0.1, 31).write(inset("first"));
    insetAt(-70.0, -20.0, 0.04, 26).write(inset("andes"));
    built("old", {inset("first"), inset("andes")});
    TestRaster(10.5, 50.0, 0.08, 0.08, 21, 21, hills).write(inset("first"));
    expectSame({inset("first"), inset("andes")});
    expectSame({});
}

TEST_F(Update, VoidsAreFilledAnewWhereARasterBelowThemChanges) {
    // The raster that is added has part of the void's rim; what it changes reaches beyond its own border.
    TestRaster fine(10.0, 40.0, 0.02, 0.02, 201, 201, [](double latitudeDeg, double longitudeDeg) {
        const bool isVoid = std::abs(latitudeDeg - 38.0) < 0.9 && std::abs(longitudeDeg - 12.0) < 0.9;
        return isVoid ? std::nan("") : bumps(latitudeDeg, longitudeDeg);
    });
    fine.setNodata(-9999.0);
    fine.write(inset("fine"));
    TestRaster(10.5, 40.0, 0.1, 0.1, 12, 41, [](double, double) { return 3000.0; }).write(inset("middle"));
    built("old", {inset("fine"), "--levels", "4"});
    EXPECT_GT(expectSame({inset("fine"), inset("middle"), "--levels", "4"}), 0);
    EXPECT_GT(expectSame({inset("fine"), "--levels", "4"}), 0);
}

TEST_F(Update, TilesOfAMapProjectionThatAreAddedAndReplaced) {
    const auto write = [this](const std::string& name, double x, double y, double lift) {
        TestRaster tile(x, y, 1000.0, 1000.0, 30, 30, [=](double north, double east) {
            return 1000.0 + lift + 300.0 * std::sin(north / 4000.0) * std::cos(east / 3000.0);
        });
        tile.setReference("EPSG:25833");
        tile.write(inset(name));
        return inset(name);
    };
    const std::string first = write("first", 600500.0, 6000500.0, 0.0);
    const std::string beside = write("beside", 630500.0, 6000500.0, 0.0);
    const std::string south = write("south", 600500.0, 5970500.0, 0.0);
    built("old", {first, "--levels", "6"});
    expectSame({first, beside, south, "--levels", "6"});
    (void)write("beside", 630500.0, 6000500.0, 100.0);
    expectSame({first, beside, south, "--levels", "6"});
    expectSame({first, south, "--levels", "6"});
}

TEST_F(Update, ImagesThatAreAddedReplacedOrTakenAway) {
    const auto write = [this](const std::string& name, double west, double spacingDeg, const Colour& colour) {
        TestImage::square(west, 50.0, spacingDeg, 60, colour).write(folder.file(name));
        return folder.file(name);
    };
    const std::string coarse = write("coarse.tif", 0.0, 0.5, {20, 30, 200});
    const std::string fine = write("fine.tif", 8.0, 0.05, {200, 30, 20});
    TestRaster::globe(1.0, hills).write(globe());
    built("old", {"--levels", "2"});
    const int first = expectSame({"--levels", "2", "--image", coarse});
    // The band of the finer image depends on the coarser one.
    const int second = expectSame({"--levels", "2", "--image", coarse, "--image", fine});
    EXPECT_GT(second, 1);
    EXPECT_LT(second, first) << first;
    EXPECT_LT(5 * first, static_cast<int>(files("old").size()));
    (void)write("fine.tif", 8.0, 0.05, {20, 200, 30});
    expectSame({"--levels", "2", "--image", fine});
}

TEST_F(Update, FewFilesAreWrittenForASmallInset) {
    TestRaster::globe(1.0, hills).write(globe());
    insetAt(7.2, 46.9, 0.02, 51).write(inset("alps"));
    built("old", {});
    const std::size_t before = files("old").size();
    ASSERT_GT(before, 600U);
    const int written = expectSame({inset("alps")});
    EXPECT_GT(written, 3);
    EXPECT_LE(30 * written, static_cast<int>(before)) << written << " of " << before;
}

TEST_F(Update, NothingIsWrittenWhereNothingHasChanged) {
    built("old", {});
    const auto before = fs::last_write_time(root("old"));
    const Outcome outcome = run(command("old", {"--update"}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("nothing has changed"), std::string::npos) << outcome.output;
    EXPECT_EQ(fs::last_write_time(root("old")), before);
}

TEST_F(Update, OtherSettingsAndUnknownDatabasesAreRefused) {
    const auto expectRefused = [&](const Words& words, const std::string& what) {
        Words all = command("old", words);
        const Files before = files("old");
        all.push_back("--update");
        const Outcome outcome = run(all);
        EXPECT_NE(outcome.exitCode, 0);
        EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
        EXPECT_EQ(files("old"), before);
    };
    expectRefused({}, "without --update");
    built("old", {});
    expectRefused({"--lod-factor", "6"}, "other settings");
    expectRefused({"--compress"}, "other settings");
    expectRefused({"--levels", "3"}, "other settings");
    fs::remove(root("old") + ".sources");
    expectRefused({}, "without --update");
}

TEST_F(Update, ReadersAlwaysFindAWholeDatabase) {
    insetAt(10.3, 51.7, 0.01, 101).write(inset("alps"));
    built("old", {});
    Words words = command("old", {inset("alps"), "--update", "--quiet"});
    Program program(words);
    int looks = 0;
    while (program.isRunning()) {
        // Throws when a file that another one names is missing or broken.
        ASSERT_NO_THROW((void)loadDatabase(root("old")));
        ++looks;
    }
    EXPECT_EQ(program.wait().exitCode, 0);
    EXPECT_GE(looks, 1);
}

}  // namespace

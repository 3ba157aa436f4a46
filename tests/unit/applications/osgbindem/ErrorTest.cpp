// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Every bad input: an exit code, one line on stderr that says what is wrong, and nothing left behind.

#include "DatabaseWalk.h"
#include "Program.h"
#include "TestRaster.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

namespace fs = std::filesystem;

class Error : public testing::Test {
protected:
    void SetUp() override {
        TestRaster::globe(2.0, hills).write(good());
        fs::create_directory(_folder.file("out"));
    }

    [[nodiscard]] std::string good() const { return _folder.file("good.tif"); }
    [[nodiscard]] std::string file(const std::string& name) const { return _folder.file(name); }
    [[nodiscard]] std::string output() const { return _folder.file("out/earth.osgb"); }

    void expectError(const std::vector<std::string>& arguments, const std::string& what, unsigned long sizeLimit = 0) {
        expectOutcome(run(arguments, sizeLimit), what, 1);
    }

    void expectUsageError(const std::vector<std::string>& arguments, const std::string& what) {
        expectOutcome(run(arguments), what, 2);
    }

    void expectOutcome(const Outcome& outcome, const std::string& what, int exitCode) {
        EXPECT_EQ(outcome.exitCode, exitCode);
        EXPECT_EQ(outcome.errors.rfind("osgbindem: ", 0), 0U) << outcome.errors;
        EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
        EXPECT_EQ(outcome.errors.find('\n'), outcome.errors.size() - 1) << outcome.errors;
        EXPECT_TRUE(fs::is_empty(_folder.file("out")));
    }

    void expectBadDem(const std::string& dem, const std::string& what) { expectError({dem, "-o", output()}, what); }

private:
    TempFolder _folder;
};

// GDAL itself would search such a file for its rows without end.
TEST_F(Error, TruncatedRasterOfText) {
    std::ofstream text(file("short.asc"));
    text << "ncols 4\nnrows 80000\nxllcorner 10\nyllcorner 0\ncellsize 0.001\n";
    for (int row = 0; row < 2000; ++row) text << "1 2 3 4\n";
    text.close();
    expectBadDem(file("short.asc"), "short.asc");
}

// HDF5 prints a stack of its own, which is not for users.
TEST_F(Error, TruncatedRasterOfHdf5) {
    std::ofstream file(this->file("short.h5"), std::ios::binary);
    file << "\x89HDF\r\n\x1a\n" << std::string("\0\0\0\0\0\x08\x08\0\x04\0\x10\0\0\0\0\0", 16) << std::string(40, '\0');
    file.close();
    expectBadDem(this->file("short.h5"), "short.h5");
}

TEST_F(Error, BandsAndOptionsOfGdal) {
    expectError({good(), "-b", "2", "-o", output()}, "no band 2");
    build({good(), "-o", output(), "--config", "GDAL_CACHEMAX", "100", "--config", "GDAL_NUM_THREADS", "1", "--levels",
           "0", "--cells", "4"});
}

TEST_F(Error, PixelsLargerThanAGlobe) {
    TestRaster(-500.0, 80.0, 900.0, 1.0, 2, 2, hills).write(file("wide.tif"));
    expectBadDem(file("wide.tif"), "larger than a globe");
}

TEST_F(Error, HeightsThatAreDistancesFromTheMiddle) {
    TestRaster moon = TestRaster::globe(5.0, [](double, double) { return 1.0; });
    moon.setReference("+proj=longlat +R=1737400 +no_defs");
    moon.write(file("moon.tif"));
    GDALDataset* dataset = GDALDataset::Open(file("moon.tif").c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
    dataset->GetRasterBand(1)->SetOffset(1737400.0);
    GDALClose(GDALDataset::ToHandle(dataset));
    expectBadDem(file("moon.tif"), "--radii");
    // The moon and the earth are no globe together.
    moon.write(file("moon.tif"));
    expectError({good(), file("moon.tif"), "-o", output()}, "--radii 1737400 1737400");
}

TEST_F(Error, RasterWithoutGeoreferencing) {
    GDALAllRegister();
    GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file("plain.tif").c_str(), 10, 10, 1,
                                                                       GDT_Float32, nullptr));
    expectBadDem(file("plain.tif"), "no georeferencing");
}

TEST_F(Error, CoordinatesThatAreNoDegrees) {
    TestRaster raster(400000.0, 5600000.0, 500.0, 500.0, 20, 20, hills);
    raster.setReference("");
    raster.write(file("metres.tif"));
    expectBadDem(file("metres.tif"), "no reference system");
}

TEST_F(Error, RasterBeyondThePoles) {
    TestRaster(0.0, 200.0, 1.0, 1.0, 20, 20, hills).write(file("beyond.tif"));
    expectBadDem(file("beyond.tif"), "latitudes -90 and 90");
}

TEST_F(Error, RasterWithoutAnyData) {
    TestRaster raster(0.0, 20.0, 1.0, 1.0, 20, 20, [](double, double) { return std::nan(""); });
    raster.setNodata(-9999.0);
    raster.write(file("empty.tif"));
    expectBadDem(file("empty.tif"), "only missing data");
}

TEST_F(Error, CommandLine) {
    const std::pair<std::vector<std::string>, const char*> wrongOptions[] = {
        {{"--levels", "40"}, "--levels: Value 40"},
        {{"--levels", "-1"}, "--levels: Value -1"},
        {{"--levels", "two"}, "two"},
        {{"--cells", "7"}, "--cells: 7 is not even"},
        {{"--cells", "900"}, "--cells: Value 900"},
        {{"--blend", "-1"}, "--blend"},
        {{"--threads", "0"}, "--threads: Value 0"},
        {{"--lod-factor", "-2"}, "--lod-factor"},
        {{"--radii", "0", "1"}, "--radii"},
        {{"--radii", "1"}, "--radii"},
        {{"--height-unit", "miles"}, "unknown unit \"miles\""},
        {{"--height-unit", "0"}, "unknown unit \"0\" in --height-unit"},
        {{"--height-unit", "m", "ft"}, "2 units"},
        {{"--band", "0"}, "--band"},
        {{"--config", "GDAL_CACHEMAX"}, "--config"},
        {{"--frobnicate"}, "--frobnicate"}};
    for (const auto& [words, what] : wrongOptions) {
        std::vector<std::string> command{good(), "-o", output()};
        command.insert(command.end(), words.begin(), words.end());
        expectUsageError(command, what);
    }
    expectUsageError({}, "--output");
    expectUsageError({"-o", output()}, "no elevation raster");
    expectUsageError({good(), "-o", file("out/earth.ive")}, ".osgb");
}

TEST_F(Error, FilesAndFolders) {
    expectError({good(), "--geoid", "absent.gtx", "-o", output()}, "absent.gtx");
    expectError({good(), "--image", file("absent.png"), "-o", output()}, "absent.png");
    expectError({good(), "-o", file("absent/earth.osgb")}, "absent");
    expectError({good(), "-o", good() + "/earth.osgb"}, "good.tif");
    expectError({good(), "-o", "/proc/earth.osgb"}, "/proc/earth.osgb");
    expectBadDem(file("absent.tif"), "absent.tif");
    std::ofstream(file("text.tif")) << "no raster";
    expectBadDem(file("text.tif"), "text.tif");
    fs::copy_file(good(), file("short.tif"));
    fs::resize_file(file("short.tif"), fs::file_size(good()) / 2);
    expectBadDem(file("short.tif"), "short.tif");
}

TEST_F(Error, SomebodyElsesFolderIsNotReplaced) {
    fs::create_directory(file("earth_tiles"));
    std::ofstream(file("earth_tiles/diary.txt")) << "mine";
    expectError({good(), "-o", file("earth.osgb")}, "move it away");
    EXPECT_TRUE(fs::exists(file("earth_tiles/diary.txt")));
}

TEST_F(Error, AFullDiskIsNoticedAndTheRerunCompletes) {
    // A limit on the size of files stands in for the full disk.
    expectError({good(), "--levels", "1", "--cells", "4", "-o", output()}, "cannot write", 4000);
    build({good(), "--levels", "1", "--cells", "4", "-o", output()});
    // The old database survives a failing run.
    const Outcome outcome = run({good(), "--levels", "0", "--cells", "4", "-o", output(), "--overwrite"}, 30000);
    EXPECT_NE(outcome.exitCode, 0);
    EXPECT_EQ(loadDatabase(output()).deepestLevel(), 1);
    build({good(), "--levels", "0", "--cells", "4", "-o", output(), "--overwrite"});
    EXPECT_EQ(loadDatabase(output()).deepestLevel(), 0);
}

TEST_F(Error, InterruptedRunsLeaveNothingThatHindersTheNextOne) {
    TestRaster::globe(0.5, hills).write(file("fine.tif"));
    Program program({file("fine.tif"), "--cells", "4", "-o", output()});
    while (program.isRunning() && !fs::exists(file("out/earth_tiles.partial/X00_Y0"))) {
    }
    const Outcome second = run({good(), "-o", output()});
    EXPECT_NE(second.exitCode, 0);
    EXPECT_NE(second.errors.find("another osgbindem"), std::string::npos) << second.errors;
    ASSERT_TRUE(program.isRunning());
    program.interrupt();
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exitCode, 130);
    EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos);
    EXPECT_FALSE(fs::exists(output()));
    EXPECT_FALSE(fs::exists(file("out/earth_tiles.lock")));
    build({good(), "--levels", "1", "--cells", "4", "-o", output()});
    EXPECT_EQ(loadDatabase(output()).deepestLevel(), 1);
    EXPECT_FALSE(fs::exists(file("out/earth_tiles.partial")));
}

TEST_F(Error, WhatAKilledRunLeftIsClearedAway) {
    fs::create_directories(file("out/earth_tiles.partial/X00_Y0"));
    std::ofstream(file("out/earth_tiles.partial/X00_Y0/L01_X0_Y0.osgb.tmp")) << "half";
    std::ofstream(file("out/earth_tiles.lock"));
    build({good(), "--levels", "1", "--cells", "4", "-o", output()});
    EXPECT_FALSE(fs::exists(file("out/earth_tiles.partial")));
    EXPECT_FALSE(fs::exists(file("out/earth_tiles.lock")));
    EXPECT_EQ(loadDatabase(output()).deepestLevel(), 1);
}

TEST(Help, NamesUnitsAndAnExample) {
    const Outcome outcome = run({"--help"});
    EXPECT_EQ(outcome.exitCode, 0);
    for (const char* word :
         {"--height-unit", "--te", "--blend", "--levels", "--lod-factor", "metres", "degrees", "Example"}) {
        EXPECT_NE(outcome.output.find(word), std::string::npos) << word;
    }
}

TEST(Progress, IsShownUnlessQuiet) {
    const TempFolder folder;
    TestRaster::globe(5.0, hills).write(folder.file("globe.tif"));
    const Outcome outcome = run({folder.file("globe.tif"), "--cells", "4", "-o", folder.file("earth.osgb")});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.output.rfind("0...10...20...30...40...50...60...70...80...90...100 - done.\n", 0), 0U)
        << outcome.output;
}

TEST(Summary, TellsWhatWasBuiltAndWhatIsMissing) {
    const TempFolder folder;
    // Post by post as those of the start tiles, with one summit, one void and an empty southern hemisphere.
    TestRaster raster(-180.0, 90.0, 22.5 / 24.0, 22.5 / 24.0, 384, 97, [](double latitude, double longitude) {
        if (latitude == 45.0 && longitude == 90.0) return 3210.0;
        return latitude == 22.5 && longitude == -90.0 ? std::nan("") : 100.0;
    });
    raster.setNodata(-9999.0);
    raster.write(folder.file("north.tif"));
    const Outcome outcome = run({folder.file("north.tif"), "-o", folder.file("earth.osgb")});
    EXPECT_EQ(outcome.exitCode, 0);
    for (const char* word :
         {"128 tiles in levels 0 to 0, 1 files", "heights from 100.0 m (", "to 3210.0 m (45.0000 N, 90.0000 E)",
          "1 are filled voids", "of 73728 posts", "36864 are at 0 m"}) {
        EXPECT_NE(outcome.output.find(word), std::string::npos) << word << " in " << outcome.output;
    }
    EXPECT_NE(outcome.errors.find("no raster has data for 36864 of 73728 posts"), std::string::npos) << outcome.errors;
    build({folder.file("north.tif"), "-o", folder.file("earth.osgb"), "--overwrite"});
}

TEST(Summary, NamesMarksUnitsAndVerticalReferences) {
    const TempFolder folder;
    TestRaster raster =
        TestRaster::globe(5.0, [](double latitude, double) { return latitude > 80.0 ? -99999.0 : 328.0; });
    raster.setReference("EPSG:4326+6360");
    raster.write(folder.file("globe.tif"));
    const Outcome outcome =
        run({folder.file("globe.tif"), "--geoid", "egm96", "--levels", "0", "-o", folder.file("earth.osgb")});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    for (const char* word :
         {"144 posts with numbers like -99999, which no terrain has (where they are heights, see --height-unit)",
          "0.30480061 m", "above the geoid EGM96"}) {
        EXPECT_NE(outcome.output.find(word), std::string::npos) << word << " in " << outcome.output;
    }
}

}  // namespace

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Every bad input: an exit code, one line on stderr that says what is wrong, and nothing left behind. What the program
// says where nothing is wrong; and that it goes on with the finished parts that a run has left, and with nothing else.
// Kills, full disks and two runs at once: tests/system/crash.

#include "RasterTest.h"

namespace {

namespace fs = std::filesystem;

class Error : public RasterTest {
protected:
    void SetUp() override {
        good = savedGlobe(2.0, hills);
        fs::create_directory(file("out"));
    }

    /// Where the database would be, nothing must be left.
    void expectError(const Words& arguments, const std::string& what, int code = 1) {
        expectFailure(arguments, what, code);
        EXPECT_TRUE(fs::is_empty(file("out"))) << what;
    }
    void expectBadDem(const std::string& dem, const std::string& what) { expectError({dem, "-o", output}, what); }

    std::string good;
    const std::string output = file("out/earth.osgb");
};

// GDAL itself would search a truncated file of text for its rows without end.
TEST_F(Error, OfTruncatedRasters) {
    std::string text = "ncols 4\nnrows 80000\nxllcorner 10\nyllcorner 0\ncellsize 0.001\n";
    for (int row = 0; row < 2000; ++row) text += "1 2 3 4\n";
    expectBadDem(_folder.write("short.asc", text), "short.asc");
    fs::copy_file(good, file("short.tif"));
    fs::resize_file(file("short.tif"), fs::file_size(good) / 2);
    expectBadDem(file("short.tif"), "short.tif");
}

TEST_F(Error, OfRastersWithoutAPlaceOrHeights) {
    expectBadDem(saved(TestRaster(-500.0, 80.0, 900.0, 1.0, 2, 2, hills)), "larger than a globe");
    expectBadDem(saved(TestRaster(400000.0, 5600000.0, 500.0, 20, hills).in("")), "no reference system");
    expectBadDem(saved(TestRaster(0.0, 200.0, 1.0, 20, hills)), "latitudes -90 and 90");
    expectBadDem(saved(TestRaster(0.0, 20.0, 1.0, 20, flat(std::nan(""))).withNodata(-9999.0)), "no heights in");
    GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file("plain.tif").c_str(), 10, 10, 1,
                                                                       GDT_Float32, nullptr));
    expectBadDem(file("plain.tif"), "no georeferencing");
}

TEST_F(Error, OfHeightsThatAreDistancesFromTheMiddle) {
    const std::string moon = saved(TestRaster::globe(5.0, flat(1.0)).in("+proj=longlat +R=1737400 +no_defs"));
    // The moon and the earth are no globe together.
    expectError({good, moon, "-o", output}, "--radii 1737400 1737400");
    OpenRaster(moon, GDAL_OF_UPDATE).band().SetOffset(1737400.0);
    expectBadDem(moon, "--radii");
}

TEST_F(Error, OfTheCommandLine) {
    const std::pair<Words, const char*> wrongOptions[] = {
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
        {{"--height-unit", "miles"}, "--height-unit: miles is no unit"},
        {{"--height-unit", "0"}, "--height-unit: 0 is no unit"},
        {{"--height-unit", "m", "ft"}, "2 units"},
        {{"--band", "0"}, "--band"},
        {{"--frobnicate"}, "--frobnicate"}};
    for (const auto& [words, what] : wrongOptions) expectError(joined({good, "-o", output}, words), what, 2);
    expectError({}, "--output", 2);
    expectError({"-o", output}, "no elevation raster", 2);
    expectError({good, "-o", file("out/earth.ive")}, ".osgb", 2);
}

TEST_F(Error, OfFilesAndFolders) {
    expectError({good, "-b", "2", "-o", output}, "no band 2");
    expectError({good, "--geoid", "absent.gtx", "-o", output}, "absent.gtx");
    expectError({good, "--image", file("absent.png"), "-o", output}, "absent.png");
    expectError({good, "-o", file("absent/earth.osgb")}, "absent");
    expectError({good, "-o", good + "/earth.osgb"}, "raster0.tif");
    expectError({good, "-o", "/proc/earth.osgb"}, "/proc/earth.osgb");
    expectBadDem(file("absent.tif"), "absent.tif");
    expectBadDem(_folder.write("text.tif", "no raster"), "text.tif");
    // Somebody else's folder is not replaced.
    fs::create_directory(file("earth_tiles"));
    const std::string diary = _folder.write("earth_tiles/diary.txt", "mine");
    expectError({good, "-o", file("earth.osgb")}, "move it away");
    EXPECT_TRUE(fs::exists(diary));
}

TEST_F(Error, AnInterruptionIsToldAndSoIsASecondRun) {
    const Words words{OSGBINDEM_PROGRAM, savedGlobe(0.5, hills), "--cells", "4", "--quiet", "-o", output};
    const std::string begun = "test -e " + file("out/earth_tiles.partial/X00_Y0");
    using namespace osgAnalyticBin::test;
    const Outcome outcome = runStock(interrupted(quoted(words), begun, quoted(words)), Modules::Present);
    EXPECT_EQ(outcome.code, 130);
    EXPECT_EQ(outcome.linesWith("another osgbindem"), 1) << outcome.text;
    EXPECT_EQ(outcome.linesWith("interrupted"), 1) << outcome.text;
    EXPECT_FALSE(fs::exists(output));
    EXPECT_FALSE(fs::exists(file("out/earth_tiles.lock")));
}

class Said : public RasterTest {
protected:
    /// Runs osgbindem to the end, and looks for words in what it says.
    void expectSaid(Words arguments, const Words& words) const {
        const Outcome outcome = run(joined(std::move(arguments), {"-o", file("earth.osgb"), "--overwrite"}));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        for (const std::string& word : words)
            EXPECT_NE(outcome.text.find(word), std::string::npos) << word << " in " << outcome.text;
    }
};

TEST_F(Said, HelpNamesUnitsAndAnExample) {
    expectSaid({"--help"},
               {"--height-unit", "--te", "--blend", "--levels", "--lod-factor", "metres", "degrees", "Example"});
}

TEST_F(Said, ProgressAndWhatWasBuiltAndWhatIsMissing) {
    // Post by post as those of the start tiles, with one summit, one void and an empty southern hemisphere.
    TestRaster raster(-180.0, 90.0, 22.5 / 24.0, 22.5 / 24.0, 384, 97, [](double latitude, double longitude) {
        if (latitude == 45.0 && longitude == 90.0) return 3210.0;
        return latitude == 22.5 && longitude == -90.0 ? std::nan("") : 100.0;
    });
    expectSaid({saved(raster.withNodata(-9999.0))},
               {"0...10...20...30...40...50...60...70...80...90...100 - done.\n", "128 tiles in levels 0 to 0, 1 files",
                "heights from 0.0 to 3210.0 m", "1 are filled voids", "of 73728 posts", "36864 are at 0 m",
                "no raster has data for 36864 of 73728 posts"});
    // --quiet leaves out the warning, too.
    build({file("raster0.tif"), "-o", file("earth.osgb"), "--overwrite"});
}

TEST_F(Said, UnitsAndVerticalReferences) {
    TestRaster raster = TestRaster::globe(5.0, flat(328.0));
    expectSaid({saved(raster.in("EPSG:4326+6360")), "--geoid", "egm96", "--levels", "0"},
               {"0.30480061 m", "above the geoid EGM96"});
}

class Resume : public RasterTest {
protected:
    void SetUp() override {
        (void)TestRaster::globe(2.0, hills).write(file("globe.tif"));
        build(command(_folder.makeFolder("undisturbed")));
        // The root file is the only one that is larger than the disk: everything else is done.
        expectFailure(command(_folder.makeFolder("out")), "128 of 128 parts are kept", 1, 58);
        fs::copy(file("out"), file("ended"), fs::copy_options::recursive);
    }

    /// As the run left it that was ended.
    void startAgain() const {
        fs::remove_all(file("out"));
        fs::copy(file("ended"), file("out"), fs::copy_options::recursive);
    }

    [[nodiscard]] std::string partial(const std::string& name) const { return file("out/earth_tiles.partial/" + name); }

    [[nodiscard]] Words command(const std::string& folder) const {
        return {file("globe.tif"), "--levels", "2", "--cells", "4", "-o", folder + "/earth.osgb"};
    }

    /// Runs the command with more options. Returns: what it says first, up to the progress.
    [[nodiscard]] std::string firstLine(const Words& more = {}) const {
        const Outcome outcome = run(joined(command(file("out")), more));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return outcome.text.substr(0, outcome.text.find('\n'));
    }

    void expectTheSameFiles() const { EXPECT_TRUE(filesBelow(file("out")) == filesBelow(file("undisturbed"))); }
};

void changeByte(const std::string& path, int place) {
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(place).put('\7');
}

TEST_F(Resume, WhatIsDoneIsNotDoneAgainUnlessItIsMissingOrDamaged) {
    const auto time = fs::last_write_time(partial("X05_Y4/L01_X10_Y8.osgb"));
    EXPECT_EQ(firstLine(), "resumes: 128 of 128 parts are done");
    EXPECT_EQ(fs::last_write_time(file("out/earth_tiles/X05_Y4/L01_X10_Y8.osgb")), time);
    expectTheSameFiles();
    // as a run with --overwrite leaves it: the finished database, and parts of the new one
    fs::copy(file("ended/earth_tiles.partial"), partial(""), fs::copy_options::recursive);
    const Files finished = filesBelow(file("out/earth_tiles"));
    expectFailure(command(file("out")), "--overwrite");
    EXPECT_TRUE(filesBelow(file("out/earth_tiles")) == finished);
    EXPECT_EQ(firstLine({"--overwrite"}), "resumes: 128 of 128 parts are done");
    expectTheSameFiles();

    startAgain();
    fs::remove(partial("state/X00_Y0/L00_X0_Y0.task"));
    fs::resize_file(partial("state/X01_Y0/L00_X1_Y0.task"), 100);
    changeByte(partial("state/X02_Y0/L00_X2_Y0.task"), 400);
    fs::remove(partial("X03_Y0/L02_X14_Y2.osgb"));
    fs::resize_file(partial("X04_Y0/L01_X8_Y0.osgb"), 0);
    changeByte(partial("X05_Y0/L02_X20_Y0.osgb"), 900);
    std::ofstream(partial("X06_Y0/L01_X12_Y0.osgb.tmp")) << "half";
    fs::remove(partial("state/X06_Y0/L00_X6_Y0.task"));
    EXPECT_EQ(firstLine({"--threads", "3"}), "resumes: 126 of 128 parts are done");
    expectTheSameFiles();
}

TEST_F(Resume, AnotherCommandOrRasterStartsAnew) {
    EXPECT_EQ(firstLine({"--lod-factor", "5"}).rfind("starts again: ", 0), 0U);
    EXPECT_FALSE(fs::exists(partial("")));
    startAgain();
    (void)TestRaster::globe(2.0, flat(7.0)).write(file("globe.tif"));
    EXPECT_EQ(firstLine().rfind("starts again: ", 0), 0U);
}

}  // namespace

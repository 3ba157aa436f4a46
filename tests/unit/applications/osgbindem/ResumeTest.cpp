// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// A run goes on with the finished parts that another one has left, and with nothing else.

#include "Program.h"
#include "TestRaster.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

namespace fs = std::filesystem;

class Resume : public testing::Test {
protected:
    void SetUp() override {
        TestRaster::globe(2.0, hills).write(raster());
        fs::create_directory(_folder.file("undisturbed"));
        build(command("undisturbed"));
        // The root file is the only one that is larger than this: everything else is done.
        fs::create_directory(_folder.file("out"));
        const Outcome outcome = run(command("out"), 30000);
        ASSERT_NE(outcome.exitCode, 0);
        ASSERT_NE(outcome.errors.find("128 of 128 parts are kept"), std::string::npos) << outcome.errors;
        ASSERT_EQ(outcome.errors.find('\n'), outcome.errors.size() - 1);
        copy("out", "ended");
    }

    /// Links suffice: the program replaces files.
    void copy(const std::string& from, const std::string& to) const {
        fs::copy(_folder.file(from), _folder.file(to),
                 fs::copy_options::recursive | fs::copy_options::create_hard_links);
    }

    /// As the run left it that was ended.
    void startAgain() {
        fs::remove_all(_folder.file("out"));
        copy("ended", "out");
    }

    [[nodiscard]] std::string raster() const { return _folder.file("globe.tif"); }
    [[nodiscard]] std::string out(const std::string& name) const { return _folder.file("out/" + name); }
    [[nodiscard]] std::string partial(const std::string& name) const { return out("earth_tiles.partial/" + name); }

    [[nodiscard]] std::vector<std::string> command(const std::string& folder) const {
        return {raster(), "--levels", "2", "--cells", "4", "-o", _folder.file(folder + "/earth.osgb")};
    }

    /// Runs the command with more options. Returns: what it says first, up to the progress.
    std::string firstLine(const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = command("out");
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return outcome.output.substr(0, outcome.output.find('\n'));
    }

    void expectTheSameFiles() {
        EXPECT_TRUE(filesBelow(_folder.file("out")) == filesBelow(_folder.file("undisturbed")));
    }

    TempFolder _folder;
};

TEST_F(Resume, WhatIsDoneIsNotDoneAgain) {
    const auto time = fs::last_write_time(partial("X05_Y4/L01_X10_Y8.osgb"));
    EXPECT_EQ(firstLine(), "resumes: 128 of 128 parts are done");
    EXPECT_EQ(fs::last_write_time(out("earth_tiles/X05_Y4/L01_X10_Y8.osgb")), time);
    expectTheSameFiles();
    // as a run with --overwrite leaves it: the finished database, and parts of the new one
    copy("ended/earth_tiles.partial", "out/earth_tiles.partial");
    const auto finished = filesBelow(_folder.file("out/earth_tiles"));
    const Outcome refused = run(command("out"));
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.errors.find("--overwrite"), std::string::npos) << refused.errors;
    EXPECT_TRUE(filesBelow(_folder.file("out/earth_tiles")) == finished);
    EXPECT_EQ(firstLine({"--overwrite"}), "resumes: 128 of 128 parts are done");
    expectTheSameFiles();
}

TEST_F(Resume, PartsThatAreMissingOrDamagedAreDoneAgain) {
    fs::remove(partial("state/X00_Y0/L00_X0_Y0.task"));
    fs::resize_file(partial("state/X01_Y0/L00_X1_Y0.task"), 100);
    std::fstream(partial("state/X02_Y0/L00_X2_Y0.task"), std::ios::in | std::ios::out | std::ios::binary)
        .seekp(400)
        .put('\7');
    fs::remove(partial("X03_Y0/L02_X14_Y2.osgb"));
    fs::resize_file(partial("X04_Y0/L01_X8_Y0.osgb"), 0);
    std::fstream(partial("X05_Y0/L02_X20_Y0.osgb"), std::ios::in | std::ios::out | std::ios::binary)
        .seekp(900)
        .put('\7');
    std::ofstream(partial("X06_Y0/L01_X12_Y0.osgb.tmp")) << "half";
    fs::remove(partial("state/X06_Y0/L00_X6_Y0.task"));
    EXPECT_EQ(firstLine({"--threads", "3"}), "resumes: 126 of 128 parts are done");
    expectTheSameFiles();
}

TEST_F(Resume, AnotherCommandOrRasterStartsAnew) {
    EXPECT_EQ(firstLine({"--restart"}).rfind("starts again: ", 0), 0U);
    expectTheSameFiles();
    startAgain();
    fs::remove_all(partial(""));
    EXPECT_EQ(firstLine().rfind("0...10", 0), 0U);
    expectTheSameFiles();
    startAgain();
    EXPECT_EQ(firstLine({"--lod-factor", "5"}).rfind("starts again: ", 0), 0U);
    EXPECT_FALSE(fs::exists(partial("")));
    startAgain();
    TestRaster::globe(2.0, [](double latitude, double longitude) {
        return 2.0 * hills(latitude, longitude);
    }).write(raster());
    EXPECT_EQ(firstLine().rfind("starts again: ", 0), 0U);
}

}  // namespace

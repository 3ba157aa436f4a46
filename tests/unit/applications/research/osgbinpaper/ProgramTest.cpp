// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The program from outside: what it writes, and how it fails.

#include "TestGlobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::paper {
namespace {

namespace fs = std::filesystem;
using test::Modules;
using test::Outcome;
using test::quoted;
using test::textOfFile;

class ProgramTest : public testing::Test {
protected:
    Outcome run(const std::string& arguments, const std::string& environment = {}) const {
        return test::runStock(quoted(PAPER_FILE) + " " + arguments, Modules::Absent, environment);
    }
    [[nodiscard]] std::string quick() const { return quoted(_globe.file()) + " --levels 3 --cameras 2 "; }

    void expectError(const std::string& arguments, const std::string& what, const std::string& environment = {}) const {
        const Outcome outcome = run(arguments, environment);
        EXPECT_GT(outcome.code, 0) << outcome.text;
        EXPECT_EQ(outcome.text.rfind("osgbinpaper: ", 0), 0U) << outcome.text;
        EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    }

    std::vector<std::string> namesIn(const std::string& folder) const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    TestGlobe _globe;
    test::TemporaryFolder _folder;
};

TEST_F(ProgramTest, WritesTableAndCsv) {
    const Outcome outcome = run(quick() + "--csv " + quoted(_folder / "a.csv"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(namesIn(_folder.path()), std::vector<std::string>{"a.csv"});
    EXPECT_NE(outcome.text.find("all views"), std::string::npos) << outcome.text;
    const std::string csv = textOfFile(_folder / "a.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 6);
}

TEST_F(ProgramTest, DrawsEveryFigure) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const std::string figures = _folder / "my figures";
    const Outcome outcome = run(quoted(_globe.file()) + " --levels 4 --cameras 20 --plot " + quoted(figures));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    std::vector<std::string> expected;
    for (const char* const name :
         {"figure1", "figure2", "figure3", "figure4", "figure5", "wrong_cull_corners", "wrong_cull_paper"}) {
        for (const char* const ending : {".csv", ".gp", ".png", ".svg"}) expected.push_back(name + std::string(ending));
        const std::string png = textOfFile(figures + "/" + name + ".png");
        ASSERT_GT(png.size(), 10000U) << name;
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x03\xe8", 4)) << name;  // 1000 pixels wide
        const std::string svg = textOfFile(figures + "/" + name + ".svg");
        EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
    }
    EXPECT_EQ(namesIn(figures), expected);
}

TEST_F(ProgramTest, SaysWhatIsWrong) {
    expectError(quoted(_folder / "absent.tif"), "absent.tif");
    expectError(quoted(_folder.write("text.tif", "no raster")), "text.tif");
}

TEST_F(ProgramTest, SaysWhatItCannotWrite) {
    const std::string absent = _folder / "absent/a.csv";
    const Outcome outcome = run(quick() + "--csv " + quoted(absent));
    EXPECT_GT(outcome.code, 0);
    EXPECT_NE(outcome.text.find("cannot write"), std::string::npos) << outcome.text;
    const Outcome full = test::runStock(
        "sh -c '\"" PAPER_FILE "\" --levels 1 --cameras 1 \"" + _globe.file() + "\" >/dev/full'", Modules::Absent);
    EXPECT_GT(full.code, 0);
    EXPECT_NE(full.text.find("standard output"), std::string::npos) << full.text;
    EXPECT_TRUE(namesIn(_folder.path()).empty());
}

TEST_F(ProgramTest, TakesTrueGtopo30) {
    const std::string dem = std::string(SAMPLE_DATA) + "/dem/gtopo30_w020n90_cut_3E9E_50N54N.tif";
    if (!fs::exists(dem)) GTEST_SKIP() << dem << " is absent";
    const Outcome outcome = run(quoted(dem) + " --levels 7 --cameras 2 --csv " + quoted(_folder / "a.csv"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(textOfFile(_folder / "a.csv").find("quadratic"), std::string::npos);
}

}  // namespace
}  // namespace osgAnalyticBin::paper

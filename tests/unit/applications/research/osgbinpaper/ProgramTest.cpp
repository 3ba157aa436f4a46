// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The program from outside: what it writes, and how it fails.

#include "TestGlobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <support/FailureText.h>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::paper {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::textOfFile;
using Words = std::vector<std::string>;

class Program : public testing::Test {
protected:
    static Outcome run(Words words) {
        words.insert(words.begin(), PAPER_FILE);
        return test::runStock(test::quoted(words), test::Modules::Absent);
    }
    [[nodiscard]] Words namesIn(const std::string& folder) const {
        Words names;
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    const TestGlobe _globe;
    const test::TemporaryFolder _folder;
    const std::string _csv = _folder / "a.csv";
};

TEST_F(Program, WritesTableAndCsv) {
    const Outcome outcome = run({_globe.file(), "--levels", "3", "--cameras", "2", "--csv", _csv});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"a.csv"});
    EXPECT_NE(outcome.text.find("all views"), std::string::npos) << outcome.text;
    const std::string csv = textOfFile(_csv);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 6);
    const std::string gtopo30 = SAMPLE_DATA "/dem/gtopo30_w020n90_cut_3E9E_50N54N.tif";
    if (!fs::exists(gtopo30)) GTEST_SKIP() << gtopo30 << " is absent";
    EXPECT_EQ(run({gtopo30, "--levels", "7", "--cameras", "2", "--csv", _csv}).code, 0);
    EXPECT_NE(textOfFile(_csv).find("quadratic"), std::string::npos);
}

TEST_F(Program, DrawsEveryFigure) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const std::string figures = _folder / "my figures";
    const Outcome outcome = run({_globe.file(), "--levels", "4", "--cameras", "20", "--plot", figures});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    Words expected;
    for (const char* const name :
         {"figure1", "figure2", "figure3", "figure4", "figure5", "wrong_cull_corners", "wrong_cull_paper"}) {
        for (const char* const ending : {".csv", ".gp", ".png", ".svg"}) expected.push_back(name + std::string(ending));
        const std::string png = textOfFile(figures + "/" + name + ".png");
        ASSERT_GT(png.size(), 10000U) << name;
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x03\xe8", 4)) << name;  // 1000 pixels wide
        EXPECT_NE(textOfFile(figures + "/" + name + ".svg").find("</svg>"), std::string::npos) << name;
    }
    EXPECT_EQ(namesIn(figures), expected);
}

TEST_F(Program, SaysWhatIsWrong) {
    test::expectOneLine(run({_folder / "absent.tif"}), "osgbinpaper", "absent.tif");
    test::expectOneLine(run({_folder.write("text.tif", "no raster")}), "osgbinpaper", "text.tif");
    const Words quick{PAPER_FILE, _globe.file(), "--levels", "1", "--cameras", "1"};
    const Outcome full = test::runStock("sh -c \"" + test::quoted(quick) + " >/dev/full\"", test::Modules::Absent);
    test::expectOneLine(full, "osgbinpaper", "standard output");
    const Outcome absent = run({_globe.file(), "--levels", "1", "--cameras", "1", "--csv", _folder / "absent/a.csv"});
    EXPECT_EQ(absent.code, 1);
    EXPECT_EQ(absent.linesWith("cannot write"), 1) << absent.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"text.tif"});
}

}  // namespace
}  // namespace osgAnalyticBin::paper

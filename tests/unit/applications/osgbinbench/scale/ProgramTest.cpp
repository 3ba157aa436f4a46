// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

//
// The plugin and the programs as users run them.

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using nlohmann::json;
using test::Modules;
using test::Outcome;
using test::TemporaryFolder;

constexpr const char* kQuiet = "ASAN_OPTIONS=detect_leaks=0";

Outcome runScale(const std::string& arguments) {
    return test::runStock("timeout 300 " + test::quoted(BENCH_FILE) + " scale " + arguments, Modules::Absent, kQuiet);
}

json jsonFile(const std::string& file) {
    return json::parse(test::textOfFile(file), nullptr, false);
}

// Needs OSG_LIBRARY_PATH.
TEST(GlobePlugin, OpensByNameAloneAndBelowTheBins) {
    for (const char* const name :
         {"2.proceduralglobe", "(levels=2,cells=4).proceduralglobe", "2.proceduralglobe.(method=exact).analyticbin",
          "1-5-6.(levels=2).proceduralglobe"}) {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(name);
        ASSERT_TRUE(node) << name;
        EXPECT_TRUE(node->getBound().valid()) << name;
    }
}

TEST(GlobePlugin, SaysWhatIsWrong) {
    osgDB::ReaderWriter::ReadResult result =
        osgDB::Registry::instance()->readNode("(cells=3).proceduralglobe", nullptr);
    EXPECT_FALSE(result.validNode());
    EXPECT_NE(result.message().find("malformed parameter \"cells=3\""), std::string::npos) << result.message();
}

TEST(ScaleProgram, TheOracleDrawsWhatItRepeats) {
    const TemporaryFolder folder;
    const Outcome outcome = runScale(
        "--series depth,residents --levels 3 --methods bins,oracle --residents 1,300 --poses 3 --cells "
        "4 "
        "--rounds 1 --json " +
        test::quoted(folder / "scale.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const json result = jsonFile(folder / "scale.json");
    for (const char* const series : {"depth", "residents"}) {
        const json& rows = result[series];
        ASSERT_EQ(rows.size() % 2, 0U);
        for (std::size_t i = 0; i < rows.size(); i += 2) {
            EXPECT_EQ(rows[i]["drawn_tiles"], rows[i + 1]["drawn_tiles"]) << series;
            EXPECT_EQ(rows[i + 1]["method"], "oracle");
            EXPECT_GT(rows[i + 1]["cull_ms"], 0.0);
        }
    }
}

TEST(ScaleProgram, WritesWhatItMeasured) {
    const TemporaryFolder folder;
    const Outcome outcome = runScale(
        "--levels 2,4 --methods none,sphere,exact+horizon+edges --residents 1,600 --memory-tiles 40 --poses 3 "
        "--cells 4 --rounds 1 --json " +
        test::quoted(folder / "scale.json") + " --csv " + test::quoted(folder / "scale.csv"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const json result = jsonFile(folder / "scale.json");
    ASSERT_EQ(result["depth"].size(), 6U);
    for (const json& row : result["depth"]) {
        EXPECT_GT(row["drawn_tiles"], 0) << row;
        EXPECT_GE(row["tested_tiles"], row["kept_tiles"]);
        EXPECT_GT(row["cull_us_per_drawn_tile"], 0.0);
    }
    EXPECT_LT(result["depth"][2]["drawn_tiles"], result["depth"][1]["drawn_tiles"]);
    EXPECT_LT(result["depth"][1]["drawn_tiles"], result["depth"][0]["drawn_tiles"]);
    ASSERT_EQ(result["residents"].size(), 6U);
    for (std::size_t i = 0; i < 3; ++i) {
        // The same view, whatever else is in memory.
        EXPECT_EQ(result["residents"][i]["tested_tiles"], result["residents"][i + 3]["tested_tiles"]);
        EXPECT_EQ(result["residents"][i]["drawn_tiles"], result["residents"][i + 3]["drawn_tiles"]);
        EXPECT_GE(result["residents"][i + 3]["paged_lods"], 600);
    }
    ASSERT_EQ(result["memory"].size(), 4U);
    EXPECT_EQ(result["memory"][0]["method"], "no bins");
    const std::string csv = test::textOfFile(folder / "scale.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 17);
    EXPECT_EQ(csv.find("series,levels,method,tested_tiles"), 0U);
}

TEST(ScaleProgram, DrawsFigures) {
    if (!std::filesystem::exists("/usr/bin/gnuplot")) GTEST_SKIP() << "needs gnuplot";
    const TemporaryFolder folder;
    const Outcome outcome =
        runScale("--series depth --levels 1,2 --poses 2 --cells 2 --rounds 1 --plot " + test::quoted(folder.path()));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        files.insert(entry.path().filename().string());
        const bool isPicture = entry.path().extension() == ".png" || entry.path().extension() == ".svg";
        EXPECT_GT(entry.file_size(), isPicture ? 1000U : 10U);
    }
    EXPECT_EQ(files, (std::set<std::string>{"depth.csv", "depth.gp", "depth.png", "depth.svg", "flight.csv",
                                            "flight.gp", "flight.png", "flight.svg"}));
    EXPECT_EQ(test::textOfFile(folder.path() + "/depth.csv").find("x,sphere,bins,oracle"), 0U);
}

TEST(ScaleProgram, SaysInOneLineWhatIsWrong) {
    const struct {
        const char* arguments;
        const char* part;
        int code = 2;
    } cases[] = {{"--methods cube", "--methods: unknown method \"cube\""},
                 {"--methods sphere+horizon", "--methods: unknown method"},
                 {"--levels 25", "--levels"},
                 {"--cells 3", "--cells: 3 is odd"},
                 {"--series memory,shape", "--series: unknown series \"shape\""},
                 {"--json /absent/scale.json", "--json: there is no folder", 1},
                 {"--residents 1000000 --series residents --methods sphere --rounds 0", "--rounds"}};
    for (const auto& wrong : cases) {
        const Outcome outcome = runScale(wrong.arguments);
        EXPECT_EQ(outcome.code, wrong.code) << wrong.arguments;
        EXPECT_EQ(outcome.linesWith("osgbinbench scale: "), 1) << outcome.text;
        EXPECT_EQ(outcome.linesWith(wrong.part), 1) << outcome.text;
    }
    EXPECT_EQ(runScale("--help").code, 0);
}

}  // namespace
}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The plugin and the programs as users run them.

#include "BenchProgram.h"

#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <algorithm>
#include <support/Programs.h>

namespace osgAnalyticBin {
namespace {

using nlohmann::json;
using test::Outcome;

// Needs OSG_LIBRARY_PATH.
TEST(GlobePlugin, OpensByNameAloneAndBelowTheBinsAndSaysWhatIsWrong) {
    for (const char* const name :
         {"2.proceduralglobe", "(levels=2,cells=4).proceduralglobe", "2.proceduralglobe.(method=exact).analyticbin",
          "1-5-6.(levels=2).proceduralglobe"}) {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(name);
        ASSERT_TRUE(node) << name;
        EXPECT_TRUE(node->getBound().valid()) << name;
    }
    osgDB::ReaderWriter::ReadResult result =
        osgDB::Registry::instance()->readNode("(cells=3).proceduralglobe", nullptr);
    EXPECT_FALSE(result.validNode());
    EXPECT_NE(result.message().find("malformed parameter \"cells=3\""), std::string::npos) << result.message();
}

class ScaleProgram : public testing::Test {
protected:
    static Outcome run(std::vector<std::string> words) {
        words.insert(words.begin(), "scale");
        return test::runBenchBlind(words);
    }

    // A quick run. Returns: what it writes.
    [[nodiscard]] json measured(std::vector<std::string> words) const {
        words.insert(words.end(), {"--poses", "3", "--cells", "4", "--rounds", "1", "--json", folder / "scale.json"});
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return test::jsonFile(folder / "scale.json");
    }

    const test::TemporaryFolder folder;
};

TEST_F(ScaleProgram, WritesWhatItMeasured) {
    const json result = measured({"--levels", "2,4", "--methods", "none,sphere,bins,oracle", "--residents", "1,600",
                                  "--memory-tiles", "40", "--csv", folder / "scale.csv"});
    ASSERT_EQ(result["depth"].size(), 8U);
    for (const json& row : result["depth"]) {
        EXPECT_GT(row["drawn_tiles"], 0) << row;
        EXPECT_GE(row["tested_tiles"], row["kept_tiles"]);
        EXPECT_GT(row["cull_us_per_drawn_tile"], 0.0);
    }
    const json& residents = result["residents"];
    ASSERT_EQ(residents.size(), 8U);
    for (std::size_t i = 0; i < 4; ++i) {
        // The same view, whatever else is in memory.
        EXPECT_EQ(residents[i]["tested_tiles"], residents[i + 4]["tested_tiles"]);
        EXPECT_EQ(residents[i]["drawn_tiles"], residents[i + 4]["drawn_tiles"]);
        EXPECT_GE(residents[i + 4]["paged_lods"], 600);
    }
    for (const char* const series : {"depth", "residents"}) {
        const json& rows = result[series];
        EXPECT_LT(rows[1]["drawn_tiles"], rows[0]["drawn_tiles"]) << series;
        EXPECT_LT(rows[2]["drawn_tiles"], rows[1]["drawn_tiles"]) << series;
        EXPECT_EQ(rows[3]["method"], "oracle");
        EXPECT_EQ(rows[3]["drawn_tiles"], rows[2]["drawn_tiles"]) << "it draws what it repeats";
    }
    ASSERT_EQ(result["memory"].size(), 4U);
    EXPECT_EQ(result["memory"][0]["method"], "no bins");
    const std::string csv = test::textOfFile(folder / "scale.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
    EXPECT_EQ(csv.find("series,levels,method,tested_tiles"), 0U);
}

TEST_F(ScaleProgram, SaysInOneLineWhatIsWrong) {
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{"--methods", "cube"}, "--methods: unknown method \"cube\""},
        {{"--methods", "sphere+horizon"}, "--methods: unknown method"},
        {{"--levels", "25"}, "--levels"},
        {{"--cells", "3"}, "--cells: 3 is odd"},
        {{"--series", "memory,shape"}, "--series: unknown series \"shape\""},
        {{"--residents", "1000000", "--series", "residents", "--methods", "sphere", "--rounds", "0"}, "--rounds"}};
    for (const auto& [words, what] : cases) test::expectOneLine(run(words), "osgbinbench scale", what, 2);
    test::expectOneLine(run({"--json", "/absent/scale.json"}), "osgbinbench scale", "--json: there is no folder");
    EXPECT_EQ(run({"--help"}).code, 0);
}

}  // namespace
}  // namespace osgAnalyticBin

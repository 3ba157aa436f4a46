// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "EmptyRows.h"
#include "Failure.h"
#include "Output.h"
#include "TextFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

using support::Failure;
using support::writeFile;

std::vector<MethodFigures> twoMethods() {
    std::vector<MethodFigures> methods{{"none", emptyRows(2)}, {"sphere", emptyRows(2)}};
    methods[0].rows[0]["drawn_tiles"] = 6;
    methods[0].rows[1]["drawn_tiles"] = 4;
    methods[1].rows[0]["drawn_tiles"] = 5;
    methods[1].rows[0]["cull_ms"] = 0.25;
    methods[1].rows[1]["cull_ms"] = 0.5;
    methods[0].rows[0]["cull_cold_ms"] = 5.0;
    methods[1].rows[0]["cull_cold_ms"] = 1.0;
    methods[1].rows[1]["cull_cold_ms"] = 1.5;
    return methods;
}

TEST(Output, JsonHoldsTheSumsByMethod) {
    const auto json = nlohmann::json::parse(jsonOf(Settings(), {"a", "b"}, twoMethods()));
    EXPECT_EQ(json["poses"], 2);
    EXPECT_EQ(json["methods"]["none"]["drawn_tiles"], 10);
    EXPECT_EQ(json["methods"]["sphere"]["drawn_tiles"], 5);
    EXPECT_DOUBLE_EQ(json["methods"]["sphere"]["cull_ms"].get<double>(), 0.75);
    EXPECT_DOUBLE_EQ(json["methods"]["sphere"]["cull_cold_ms"].get<double>(), 2.5);
    EXPECT_EQ(json["flush_mib"], Settings().flush);
    EXPECT_EQ(json["expiry"], 3.0);
    for (const char* const key :
         {"truth_tiles", "tested_tiles", "kept_tiles", "drawn_tiles", "triangles", "files_requested", "bytes",
          "paged_lods", "cull_ms", "false_culls", "false_keeps", "differing_pixels"})
        EXPECT_TRUE(json["methods"]["sphere"].contains(key)) << key;
}

TEST(Output, JsonHoldsTheSumsByPathAndEveryPose) {
    const auto json = nlohmann::json::parse(jsonOf(Settings(), {"down_1", "far"}, twoMethods()));
    ASSERT_EQ(json["paths"].size(), 2U);
    EXPECT_EQ(json["paths"]["down"]["poses"], 1);
    EXPECT_EQ(json["paths"]["down"]["methods"]["none"]["drawn_tiles"], 6);
    EXPECT_EQ(json["paths"]["far"]["methods"]["none"]["drawn_tiles"], 4);
    EXPECT_EQ(json["pose_names"], nlohmann::json::parse(R"(["down_1", "far"])"));
    EXPECT_EQ(json["by_pose"]["none"]["drawn_tiles"], nlohmann::json::parse("[6, 4]"));
    EXPECT_EQ(json["by_pose"]["sphere"]["cull_ms"], nlohmann::json::parse("[0.25, 0.5]"));
}

TEST(Output, PosesBelongToThePathThatTheirNamesBeginWith) {
    const auto groups = pathGroupsOf({"down_1", "far", "down_2", "downs_1"});
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].name, "down");
    EXPECT_EQ(groups[0].poses, (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(groups[1].name, "far");
    EXPECT_EQ(groups[2].name, "downs");
}

TEST(Output, ARecordedFlightIsOnePath) {
    const auto groups = pathGroupsOf({"p1", "p2", "p10", "valley2_1", "7"});
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].name, "p");
    EXPECT_EQ(groups[0].poses.size(), 3U);
    EXPECT_EQ(groups[1].name, "valley2") << "a number that belongs to the path";
    EXPECT_EQ(groups[2].name, "7");
}

TEST(Output, TheTableHasTheSumsOfSeveralPaths) {
    std::ostringstream several;
    print(several, tablesOf({"down_1", "far_1"}, twoMethods()));
    EXPECT_NE(several.str().find("sums by path"), std::string::npos);
    std::ostringstream one;
    print(one, tablesOf({"far_1", "far_2"}, twoMethods()));
    EXPECT_EQ(one.str().find("sums by path"), std::string::npos);
}

TEST(Output, CsvHasALineForEachPoseAndMethod) {
    std::istringstream lines(csvOf({"a", "b"}, twoMethods()));
    std::vector<std::string> begins;
    for (std::string line; std::getline(lines, line);) begins.push_back(line.substr(0, 9));
    EXPECT_EQ(begins, (std::vector<std::string>{"pose,meth", "a,none,0,", "a,sphere,", "b,none,0,", "b,sphere,"}));
    const std::string text = csvOf({"a", "b"}, twoMethods());
    EXPECT_NE(text.find(",cull_ms,cull_spread_ms,cull_cold_ms,cull_cold_spread_ms\n"), std::string::npos) << text;
    EXPECT_NE(text.find(",0.25,0,1,0\n"), std::string::npos) << text;
}

TEST(Output, TheTableHasRatiosToTheMethodsThatWereFlown) {
    std::ostringstream output;
    print(output, tablesOf({"a", "b"}, twoMethods()));
    EXPECT_NE(output.str().find("ratio to sphere"), std::string::npos);
    EXPECT_EQ(output.str().find("ratio to cluster"), std::string::npos);
    EXPECT_NE(output.str().find("drawn_tiles        2.000   1.000"), std::string::npos) << output.str();
    EXPECT_NE(output.str().find("cull_cold_ms       2.000   1.000"), std::string::npos) << output.str();
}

TEST(Output, TablesHaveTimesOverTheOracleWhereThatWasMeasured) {
    std::ostringstream without;
    print(without, tablesOf({"down_1", "far_1"}, twoMethods()));
    EXPECT_EQ(without.str().find("over_oracle"), std::string::npos);
    std::vector<MethodFigures> methods = twoMethods();
    methods.push_back({"oracle", emptyRows(2)});
    methods[2].rows[0]["cull_ms"] = 0.125;
    methods[2].rows[1]["cull_ms"] = 0.125;
    methods[2].rows[0]["cull_cold_ms"] = 1.0;
    std::ostringstream with;
    print(with, tablesOf({"down_1", "far_1"}, methods));
    EXPECT_NE(with.str().find("over_oracle        0.000   3.000   1.000"), std::string::npos) << with.str();
    EXPECT_NE(with.str().find("cold_over_oracle   5.000   2.500   1.000"), std::string::npos) << with.str();
    EXPECT_NE(with.str().find("    0.250         1.000        2.000             1.000\n"), std::string::npos)
        << "by path: " << with.str();
}

TEST(Output, AFileThatCannotBeWrittenStaysAsItWas) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("sums.json", "old");
    std::filesystem::create_directory(file + ".tmp");  // stands in the way
    EXPECT_THROW(writeFile(file, "new"), Failure);
    EXPECT_EQ(test::textOfFile(file), "old");
    std::filesystem::remove(file + ".tmp");
    writeFile(file, "new");
    EXPECT_EQ(test::textOfFile(file), "new");
    EXPECT_FALSE(std::filesystem::exists(file + ".tmp"));
}

}  // namespace
}  // namespace osgAnalyticBin::bench

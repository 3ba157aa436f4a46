// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

std::vector<MethodFigures> twoMethods() {
    std::vector<MethodFigures> methods{{"none", std::vector<Figures>(2)}, {"sphere", std::vector<Figures>(2)}};
    methods[0].poses[0].drawnTiles = 6;
    methods[0].poses[1].drawnTiles = 4;
    methods[1].poses[0].drawnTiles = 5;
    methods[1].poses[0].cullMs = 0.25;
    methods[1].poses[1].cullMs = 0.5;
    return methods;
}

TEST(Output, JsonHoldsTheSumsByMethod) {
    const auto json = nlohmann::json::parse(jsonOf(Settings(), {"a", "b"}, twoMethods()));
    EXPECT_EQ(json["poses"], 2);
    EXPECT_EQ(json["methods"]["none"]["drawn_tiles"], 10);
    EXPECT_EQ(json["methods"]["sphere"]["drawn_tiles"], 5);
    EXPECT_DOUBLE_EQ(json["methods"]["sphere"]["cull_ms"].get<double>(), 0.75);
    for (const char* const key :
         {"truth_tiles", "tested_tiles", "kept_tiles", "drawn_tiles", "triangles", "files_requested", "bytes",
          "paged_lods", "cull_ms", "false_culls", "false_keeps", "differing_pixels"})
        EXPECT_TRUE(json["methods"]["sphere"].contains(key)) << key;
}

TEST(Output, CsvHasALineForEachPoseAndMethod) {
    std::istringstream lines(csvOf({"a", "b"}, twoMethods()));
    std::vector<std::string> begins;
    for (std::string line; std::getline(lines, line);) begins.push_back(line.substr(0, 9));
    EXPECT_EQ(begins, (std::vector<std::string>{"pose,meth", "a,none,0,", "a,sphere,", "b,none,0,", "b,sphere,"}));
}

TEST(Output, TheTableHasRatiosToTheMethodsThatWereFlown) {
    std::ostringstream output;
    printTable(output, twoMethods());
    EXPECT_NE(output.str().find("ratio to sphere"), std::string::npos);
    EXPECT_EQ(output.str().find("ratio to cluster"), std::string::npos);
    EXPECT_NE(output.str().find("drawn_tiles        2.000   1.000"), std::string::npos) << output.str();
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

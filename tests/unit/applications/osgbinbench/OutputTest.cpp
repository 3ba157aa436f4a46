// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgbinbench makes of its figures: JSON, CSV, tables, diagrams (drawn by gnuplot), and the three sentences.

#include "Failure.h"
#include "Output.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <support/Programs.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

using support::Failure;
using Sentences = std::vector<std::string>;
using Poses = std::vector<std::string>;

// The figures of a number of poses, all of them 0.
MethodFigures emptyFigures(const std::string& method, std::size_t poses) {
    report::Json row;
    for (const Column& column : kPoseColumns) {
        const std::string name = column.name;
        row[name] = name.substr(name.size() - 3) == "_ms" ? report::Json(0.0) : report::Json(0U);
    }
    return {method, std::vector<report::Json>(poses, row)};
}

// Tiles drawn, and times of culls, by pose.
MethodFigures figuresOf(const std::string& method, const std::vector<unsigned int>& drawn,
                        const std::vector<double>& cullMs, const std::vector<double>& coldMs = {0.0, 0.0}) {
    MethodFigures figures = emptyFigures(method, drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        figures.rows[i]["drawn_tiles"] = figures.rows[i]["files_requested"] = drawn[i];
        figures.rows[i]["cull_ms"] = cullMs[i];
        figures.rows[i]["cull_cold_ms"] = coldMs[i];
    }
    return figures;
}

std::vector<MethodFigures> twoMethods() {
    return {figuresOf("none", {6, 4}, {0.0, 0.0}, {5.0, 0.0}), figuresOf("sphere", {5, 0}, {0.25, 0.5}, {1.0, 1.5})};
}

TEST(Output, JsonHoldsTheSumsByMethodAndPath) {
    const auto json = nlohmann::json::parse(jsonOf(Settings(), {{"down_1", "far"}, twoMethods()}));
    EXPECT_EQ(json["poses"], 2);
    EXPECT_EQ(json["methods"]["none"]["drawn_tiles"], 10);
    EXPECT_EQ(json["methods"]["sphere"]["drawn_tiles"], 5);
    EXPECT_DOUBLE_EQ(json["methods"]["sphere"]["cull_ms"].get<double>(), 0.75);
    EXPECT_DOUBLE_EQ(json["methods"]["sphere"]["cull_cold_ms"].get<double>(), 2.5);
    EXPECT_EQ(json["flush_mib"], Settings().flush);
    EXPECT_EQ(json["expiry"], 3.0);
    for (const Column& column : kPoseColumns)
        EXPECT_TRUE(json["methods"]["sphere"].contains(column.name)) << column.name;
    ASSERT_EQ(json["paths"].size(), 2U);
    EXPECT_EQ(json["paths"]["down"]["poses"], 1);
    EXPECT_EQ(json["paths"]["down"]["methods"]["none"]["drawn_tiles"], 6);
    EXPECT_EQ(json["paths"]["far"]["methods"]["none"]["drawn_tiles"], 4);
}

TEST(Output, PosesBelongToThePathThatTheirNamesBeginWith) {
    // a recorded flight, p1 and so on, is one path; a number may belong to the path
    const auto groups = pathGroupsOf({"down_1", "far", "down_2", "downs_1", "p1", "p2", "p10", "valley2_1", "7"});
    Poses names;
    for (const auto& group : groups) names.push_back(group.name);
    EXPECT_EQ(names, (Poses{"down", "far", "downs", "p", "valley2", "7"}));
    EXPECT_EQ(groups[0].poses, (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(groups[3].poses.size(), 3U);
}

TEST(Output, CsvHasALineForEachPoseAndMethod) {
    const std::string text = csvOf({{"a", "b"}, twoMethods()});
    std::istringstream lines(text);
    Poses begins;
    for (std::string line; std::getline(lines, line);) begins.push_back(line.substr(0, 9));
    EXPECT_EQ(begins, (Poses{"pose,meth", "a,none,0,", "a,sphere,", "b,none,0,", "b,sphere,"}));
    EXPECT_NE(text.find(",cull_ms,cull_spread_ms,cull_cold_ms,cull_cold_spread_ms\n"), std::string::npos) << text;
    EXPECT_NE(text.find(",0.25,0,1,0\n"), std::string::npos) << text;
}

TEST(Output, TablesHaveRatiosToWhatWasMeasuredAndSumsOfSeveralPaths) {
    const auto tables = [](const Poses& poses, const std::vector<MethodFigures>& methods) {
        std::ostringstream output;
        print(output, tablesOf({poses, methods}));
        return output.str();
    };
    const auto expectParts = [](const std::string& text, const Poses& parts, const Poses& others) {
        for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
        for (const std::string& other : others) EXPECT_EQ(text.find(other), std::string::npos) << other;
    };
    expectParts(tables({"far_1", "far_2"}, twoMethods()),
                {"ratio to sphere", "drawn_tiles        2.000   1.000", "cull_cold_ms       2.000   1.000"},
                {"ratio to cluster", "over_oracle", "sums by path"});
    std::vector<MethodFigures> methods = twoMethods();
    methods.push_back(figuresOf("oracle", {0, 0}, {0.125, 0.125}, {1.0, 0.0}));
    expectParts(tables({"down_1", "far_1"}, methods),
                {"sums by path", "over_oracle        0.000   3.000   1.000", "cold_over_oracle   5.000   2.500   1.000",
                 "    0.250         1.000        2.000             1.000\n"},
                {});
}

std::vector<Diagram> diagrams() {
    std::vector<MethodFigures> methods;
    for (const auto& [name, drawn, cullMs] : {std::tuple("none", 40U, 2.0), {"sphere", 8U, 1.0}, {"a+b_c", 4U, 0.5}}) {
        methods.push_back(emptyFigures(name, 3));
        for (report::Json& pose : methods.back().rows) {
            pose["truth_tiles"] = 4;
            pose["drawn_tiles"] = drawn;
            pose["files_requested"] = 3;
            pose["cull_ms"] = cullMs;
            pose["cull_spread_ms"] = cullMs / 4.0;
        }
    }
    return diagramsOf({{"down_1", "down_2", "far_1"}, methods});
}

const std::string& dataOf(const std::vector<Diagram>& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const Diagram& d) { return d.name == name; })->data;
}

bool hasGnuplot() {
    return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

TEST(Plot, DataHoldRatiosAndMeansByPathWithoutTheReferenceUnlessItIsAlone) {
    const std::vector<Diagram> all = diagrams();
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(dataOf(all, "drawn"), "path,sphere,a+b_c\ndown,2,1\nfar,2,1\n");
    EXPECT_EQ(dataOf(all, "files"), "path,sphere,a+b_c\ndown,3,3\nfar,3,3\n");
    EXPECT_EQ(dataOf(all, "cull"),
              "path,sphere,sphere half spread,a+b_c,a+b_c half spread\n"
              "down,1,0.125,0.5,0.0625\nfar,1,0.125,0.5,0.0625\n");
    MethodFigures none = figuresOf("none", {8, 8}, {1.0, 1.0});
    for (report::Json& pose : none.rows) pose["truth_tiles"] = 4;
    EXPECT_EQ(dataOf(diagramsOf({{"down_1", "far_1"}, {none}}), "drawn"), "path,none\ndown,2\nfar,2\n");
}

TEST(Plot, DrawsEveryDiagramTwiceAndSaysWhichFailed) {
    if (!hasGnuplot()) GTEST_SKIP() << "needs gnuplot";
    const test::TemporaryFolder folder;
    const std::string place = folder / "a folder/figures";
    plot(place, diagrams());
    for (const Diagram& diagram : diagrams()) {
        const std::string file = place + "/" + diagram.name;
        EXPECT_EQ(test::textOfFile(file + ".png").rfind("\x89PNG", 0), 0U) << diagram.name;
        EXPECT_NE(test::textOfFile(file + ".svg").find("<svg"), std::string::npos) << diagram.name;
        EXPECT_EQ(test::textOfFile(file + ".csv"), diagram.data);
    }
    // poses that nothing is counted at
    EXPECT_NO_THROW(plot(folder.path(), diagramsOf({{"a", "b"}, {emptyFigures("sphere", 2)}})));
    EXPECT_THROW(plot(folder.path(), {{"broken", ""}}), Failure);
}

TEST(Plot, KeepsDataAndTheScriptWhereThereIsNoGnuplot) {
    const test::TemporaryFolder folder;
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const std::string error = test::failureOf([&] { plot(folder.path(), diagrams()); });
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(error.find("gnuplot is not installed"), std::string::npos) << error;
    for (const Diagram& diagram : diagrams())
        EXPECT_EQ(test::textOfFile(folder / (diagram.name + ".csv")), diagram.data);
    EXPECT_NE(test::textOfFile(folder / "bars.gp").find("plot data"), std::string::npos);
}

Sentences advice(const std::vector<MethodFigures>& methods) {
    return adviceOf({{"far_1", "near_1"}, methods});
}

TEST(Advice, ComparesWithTheBetterOfTheOthersInEachFigure) {
    EXPECT_EQ(advice({figuresOf("sphere", {90, 30}, {1.0, 1.0}), figuresOf("cluster", {60, 20}, {2.0, 2.0}),
                      figuresOf("bins", {30, 10}, {0.6, 0.6})}),
              (Sentences{"Bins are worth it for this database: they draw 40 tiles where cluster callbacks draw "
                         "80 (0.50 times).",
                         "They read 40 files where cluster callbacks read 80 (0.50 times), and a cull takes "
                         "0.600 ms where it takes 1.000 ms with spheres (0.60 times).",
                         "They help on every path that was flown."}));
    const Sentences cold = advice(
        {figuresOf("sphere", {30, 30}, {1.0, 1.0}, {4.0, 0.0}), figuresOf("bins", {10, 10}, {0.5, 0.5}, {3.0, 0.0})});
    EXPECT_NE(cold[1].find("(0.50 times, and 0.75 times with cold caches)"), std::string::npos);
}

TEST(Advice, SaysWhereBinsDoNotHelpAndAdvisesAgainstThoseThatOnlyCostTime) {
    const MethodFigures sphere = figuresOf("sphere", {30, 30}, {1.0, 1.0});
    EXPECT_EQ(advice({sphere, figuresOf("bins", {10, 30}, {0.5, 1.5})}).at(2),
              "They do not help, or cost time, here: near (1.00 times the tiles, 1.50 times the cull time).");
    const Sentences against = advice({sphere, figuresOf("bins", {30, 30}, {1.2, 1.2})});
    EXPECT_EQ(against.front().rfind("Bins are not worth it for this database:", 0), 0U) << against.front();
    EXPECT_TRUE(advice({sphere}).empty());
    EXPECT_TRUE(advice({figuresOf("none", {1, 1}, {1.0, 1.0}), figuresOf("bins", {1, 1}, {1.0, 1.0})}).empty());
}

}  // namespace
}  // namespace osgAnalyticBin::bench

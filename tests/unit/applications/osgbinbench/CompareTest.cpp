// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Two measurements side by side: files made by hand.

#include "BenchProgram.h"
#include "Compare.h"
#include "Failure.h"

#include <gtest/gtest.h>

#include <sstream>
#include <support/FailureText.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

using support::Failure;

using Json = nlohmann::json;

// Two poses, spheres and bins; times with a spread of a tenth.
Json measurement() {
    return Json::parse(R"({
        "mode": "poses", "database": "earth.osgb", "path": ["p.csv"], "options": "", "vertical_scale": 1.0,
        "width": 320, "height": 240, "threading": "SingleThreaded", "osg": "3.6.5",
        "methods": {
            "sphere": {"truth_tiles": 10, "drawn_tiles": 20, "cull_ms": 2.0, "cull_spread_ms": 0.2},
            "exact": {"truth_tiles": 10, "drawn_tiles": 12, "cull_ms": 1.0, "cull_spread_ms": 0.1}},
        "pose_names": ["a", "b"],
        "by_pose": {
            "sphere": {"truth_tiles": [5, 5], "drawn_tiles": [10, 10], "cull_ms": [1, 1], "cull_spread_ms": [0.1, 0.1]},
            "exact": {"truth_tiles": [5, 5], "drawn_tiles": [6, 6], "cull_ms": [0.5, 0.5],
                      "cull_spread_ms": [0.05, 0.05]}}})");
}

struct Comparison {
    bool isWorse = false;
    std::string text;

    [[nodiscard]] bool says(const std::string& part) const { return text.find(part) != std::string::npos; }

    // The line of the table, its columns one blank apart; empty when there is none.
    [[nodiscard]] std::string line(const std::string& method, const std::string& figure) const {
        std::istringstream lines(text);
        for (std::string raw; std::getline(lines, raw);) {
            std::istringstream words(raw);
            std::string line;
            for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
            if (line.rfind(method + " " + figure + " ", 0) == 0) return line;
        }
        return {};
    }
};

Comparison compared(const Json& before, const Json& after) {
    const test::TemporaryFolder folder;
    std::ostringstream output;
    const std::string old = folder.write("old.json", before.dump());
    const bool isWorse = compareFiles(old, folder.write("new.json", after.dump()), output);
    return {isWorse, output.str()};
}

std::string errorOf(const std::string& before, const std::string& after) {
    const test::TemporaryFolder folder;
    std::ostringstream output;
    const std::string old = folder.write("old.json", before);
    return test::failureOf([&] { (void)compareFiles(old, folder.write("new.json", after), output); });
}

void setTime(Json& file, const std::string& method, double factor) {
    Json& sums = file["methods"][method];
    sums["cull_ms"] = sums["cull_ms"].get<double>() * factor;
}

// A sum's uncertainty: half a spread of a tenth, over two poses: 0.05 / sqrt(2); with four sums twice that, 0.071.
TEST(Compare, FindsNothingInTheSameFile) {
    const Comparison same = compared(measurement(), measurement());
    EXPECT_FALSE(same.isWorse);
    EXPECT_TRUE(same.says("beyond noise: 0 worse, 0 better")) << same.text;
    EXPECT_TRUE(same.says("4 counts are the same")) << same.text;
    EXPECT_FALSE(same.says("warning")) << same.text;
    EXPECT_EQ(same.line("exact", "cull_ms/sphere"), "exact cull_ms/sphere 0.5000 0.5000 1.000 0.071 within noise");
}

TEST(Compare, SaysEveryChangeOfACount) {
    Json after = measurement();
    after["methods"]["exact"]["drawn_tiles"] = 13;
    const Comparison worse = compared(measurement(), after);
    EXPECT_TRUE(worse.isWorse);
    EXPECT_EQ(worse.line("exact", "drawn_tiles"), "exact drawn_tiles 12 13 1.083 WORSE");
    const Comparison better = compared(after, measurement());
    EXPECT_FALSE(better.isWorse);
    EXPECT_EQ(better.line("exact", "drawn_tiles"), "exact drawn_tiles 13 12 0.923 better");
}

TEST(Compare, CountsThatWereZeroCanOnlyGrow) {
    Json before = measurement();
    Json after = measurement();
    before["methods"]["exact"]["false_culls"] = 0;
    after["methods"]["exact"]["false_culls"] = 1;
    EXPECT_TRUE(compared(before, after).isWorse);
    EXPECT_FALSE(compared(after, before).isWorse);
}

TEST(Compare, DoesNotJudgeWhatBelongsToTheView) {
    Json after = measurement();
    after["methods"]["exact"]["truth_tiles"] = 11;
    const Comparison comparison = compared(measurement(), after);
    EXPECT_FALSE(comparison.isWorse);
    EXPECT_EQ(comparison.line("exact", "truth_tiles"), "exact truth_tiles 10 11 1.100 changed");
}

TEST(Compare, JudgesTimesByTheSpheres) {
    Json slowMachine = measurement();
    setTime(slowMachine, "sphere", 1.5);
    setTime(slowMachine, "exact", 1.5);
    const Comparison drift = compared(measurement(), slowMachine);
    EXPECT_FALSE(drift.isWorse) << drift.text;
    EXPECT_EQ(drift.line("sphere", "cull_ms"), "sphere cull_ms 2 3 1.500");
    Json slower = slowMachine;
    setTime(slower, "exact", 1.2);
    const Comparison worse = compared(measurement(), slower);
    EXPECT_TRUE(worse.isWorse) << worse.text;
    EXPECT_NE(worse.line("exact", "cull_ms/sphere").find("1.200"), std::string::npos) << worse.text;
    EXPECT_NE(worse.line("exact", "cull_ms/sphere").find("WORSE"), std::string::npos) << worse.text;
    EXPECT_FALSE(compared(slower, measurement()).isWorse);
}

TEST(Compare, JudgesTimesAsTheyAreWithoutSpheres) {
    Json before = measurement();
    before["methods"].erase("sphere");
    Json after = before;
    setTime(after, "exact", 1.04);
    EXPECT_FALSE(compared(before, after).isWorse);
    setTime(after, "exact", 1.2);
    EXPECT_TRUE(compared(before, after).isWorse);
    after["by_pose"]["exact"].erase("cull_spread_ms");  // no noise known
    EXPECT_FALSE(compared(before, after).isWorse);
}

TEST(Compare, TakesAtLeastFivePercentForNoise) {
    Json before = measurement();
    for (const char* const method : {"sphere", "exact"}) before["by_pose"][method]["cull_spread_ms"] = {0, 0};
    Json after = before;
    setTime(after, "exact", 1.04);
    EXPECT_FALSE(compared(before, after).isWorse);
    setTime(after, "exact", 1.02);
    EXPECT_TRUE(compared(before, after).isWorse);
}

TEST(Compare, DoesNotJudgeAContinuousFlight) {
    const Json before = {{"mode", "flight"}, {"methods", {{"exact", {{"files_requested", 3}, {"cull_ms", 1.0}}}}}};
    Json after = before;
    after["methods"]["exact"] = {{"files_requested", 5}, {"cull_ms", 2.0}};
    const Comparison flight = compared(before, after);
    EXPECT_FALSE(flight.isWorse);
    EXPECT_EQ(flight.line("exact", "files_requested"), "exact files_requested 3 5 1.667 changed");
}

TEST(Compare, WarnsOnceOfOtherConditions) {
    Json after = measurement();
    after["database"] = "mars.osgb";
    after["width"] = 640;
    const Comparison comparison = compared(measurement(), after);
    EXPECT_TRUE(
        comparison.says("warning: not measured alike: database (\"earth.osgb\" and \"mars.osgb\"), "
                        "width (320 and 640)\n"))
        << comparison.text;
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    const std::string good = measurement().dump();
    Json otherPoses = measurement();
    otherPoses["pose_names"] = {"a", "c"};
    EXPECT_NE(errorOf(good, otherPoses.dump()).find("the poses are not the same"), std::string::npos);
    Json flight = measurement();
    flight["mode"] = "flight";
    EXPECT_NE(errorOf(good, flight.dump()).find("the other flew on"), std::string::npos);
    Json otherMethods = measurement();
    otherMethods["methods"] = {{"paper", {{"drawn_tiles", 1}}}};
    EXPECT_NE(errorOf(good, otherMethods.dump()).find("no method is in both"), std::string::npos);
}

TEST(Compare, NamesABrokenFile) {
    const std::string good = measurement().dump();
    EXPECT_NE(errorOf(good, "{\"mode\": ").find("new.json: is not what"), std::string::npos);
    EXPECT_NE(errorOf("[1, 2]", good).find("old.json: is not what"), std::string::npos);
    for (const char* const place : {"/methods/exact/drawn_tiles", "/methods", "/by_pose"}) {
        Json broken = measurement();
        broken[Json::json_pointer(place)] = "many";
        EXPECT_NE(errorOf(good, broken.dump()).find("new.json: "), std::string::npos) << place;
    }
    std::ostringstream output;
    EXPECT_THROW((void)compareFiles("/nowhere/a.json", "/nowhere/b.json", output), Failure);
}

TEST(Compare, TheProgramAnswersWithItsExitCode) {
    const test::TemporaryFolder folder;
    Json after = measurement();
    after["methods"]["exact"]["drawn_tiles"] = 13;
    const std::string old = test::quoted(folder.write("old.json", measurement().dump()));
    const std::string now = test::quoted(folder.write("new.json", after.dump()));
    EXPECT_EQ(test::runBenchBlind("--compare " + old + " " + now).code, 1);
    EXPECT_EQ(test::runBenchBlind("--compare " + now + " " + old).code, 0);
    EXPECT_EQ(test::runBenchBlind("--compare " + old + " /nowhere/new.json").code, 1);
    EXPECT_EQ(test::runBenchBlind("--compare " + old).code, 2);
    EXPECT_EQ(test::runBenchBlind("earth.osgb --compare " + old + " " + now).code, 2);
}

}  // namespace
}  // namespace osgAnalyticBin::bench

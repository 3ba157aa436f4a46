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

// The measurement with another value in one place, or in several.
Json with(Json file, const std::string& place, const Json& value) {
    file[Json::json_pointer(place)] = value;
    return file;
}

struct Comparison {
    bool isWorse = false;
    std::string text;

    [[nodiscard]] bool says(const std::string& part) const { return text.find(part) != std::string::npos; }

    // The line of the table, its columns one blank apart; empty when there is none.
    [[nodiscard]] std::string line(const std::string& begin) const {
        std::istringstream lines(text);
        for (std::string raw; std::getline(lines, raw);) {
            std::istringstream words(raw);
            std::string line;
            for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
            if (line.rfind(begin + " ", 0) == 0) return line;
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

void expectError(const std::string& before, const std::string& after, const std::string& what) {
    const test::TemporaryFolder folder;
    std::ostringstream output;
    const std::string old = folder.write("old.json", before);
    const std::string error =
        test::failureOf([&] { (void)compareFiles(old, folder.write("new.json", after), output); });
    EXPECT_NE(error.find(what), std::string::npos) << error;
}

// A sum's uncertainty: half a spread of a tenth, over two poses: 0.05 / sqrt(2); with four sums twice that, 0.071.
TEST(Compare, FindsNothingInTheSameFile) {
    const Comparison same = compared(measurement(), measurement());
    EXPECT_FALSE(same.isWorse);
    EXPECT_TRUE(same.says("beyond noise: 0 worse, 0 better")) << same.text;
    EXPECT_TRUE(same.says("4 counts are the same")) << same.text;
    EXPECT_FALSE(same.says("warning")) << same.text;
    EXPECT_EQ(same.line("exact cull_ms/sphere"), "exact cull_ms/sphere 0.5000 0.5000 1.000 0.071 within noise");
}

TEST(Compare, SaysEveryChangeOfACountAndDoesNotJudgeWhatBelongsToTheView) {
    const Json more = with(measurement(), "/methods/exact/drawn_tiles", 13);
    const Comparison worse = compared(measurement(), more), better = compared(more, measurement());
    EXPECT_TRUE(worse.isWorse);
    EXPECT_EQ(worse.line("exact drawn_tiles"), "exact drawn_tiles 12 13 1.083 WORSE");
    EXPECT_FALSE(better.isWorse);
    EXPECT_EQ(better.line("exact drawn_tiles"), "exact drawn_tiles 13 12 0.923 better");
    // counts that were zero can only grow
    const Json none = with(measurement(), "/methods/exact/false_culls", 0);
    const Json one = with(measurement(), "/methods/exact/false_culls", 1);
    EXPECT_TRUE(compared(none, one).isWorse);
    EXPECT_FALSE(compared(one, none).isWorse);
    const Comparison ofView = compared(measurement(), with(measurement(), "/methods/exact/truth_tiles", 11));
    EXPECT_FALSE(ofView.isWorse);
    EXPECT_EQ(ofView.line("exact truth_tiles"), "exact truth_tiles 10 11 1.100 changed");
}

TEST(Compare, JudgesTimesByTheSpheresWhereThereAreSome) {
    const Json slowMachine = with(with(measurement(), "/methods/sphere/cull_ms", 3.0), "/methods/exact/cull_ms", 1.5);
    const Comparison drift = compared(measurement(), slowMachine);
    EXPECT_FALSE(drift.isWorse) << drift.text;
    EXPECT_EQ(drift.line("sphere cull_ms"), "sphere cull_ms 2 3 1.500");
    const Json slower = with(slowMachine, "/methods/exact/cull_ms", 1.8);
    const Comparison worse = compared(measurement(), slower);
    EXPECT_TRUE(worse.isWorse) << worse.text;
    const std::string line = worse.line("exact cull_ms/sphere");
    EXPECT_NE(line.find("1.200"), std::string::npos) << line;
    EXPECT_NE(line.find("WORSE"), std::string::npos) << line;
    EXPECT_FALSE(compared(slower, measurement()).isWorse);

    Json alone = measurement();
    alone["methods"].erase("sphere");
    EXPECT_FALSE(compared(alone, with(alone, "/methods/exact/cull_ms", 1.04)).isWorse);
    Json slowAlone = with(alone, "/methods/exact/cull_ms", 1.25);
    EXPECT_TRUE(compared(alone, slowAlone).isWorse);
    slowAlone["by_pose"]["exact"].erase("cull_spread_ms");  // no noise known
    EXPECT_FALSE(compared(alone, slowAlone).isWorse);
}

TEST(Compare, TakesAtLeastFivePercentForNoise) {
    Json before = measurement();
    for (const char* const method : {"sphere", "exact"}) before["by_pose"][method]["cull_spread_ms"] = {0, 0};
    EXPECT_FALSE(compared(before, with(before, "/methods/exact/cull_ms", 1.04)).isWorse);
    EXPECT_TRUE(compared(before, with(before, "/methods/exact/cull_ms", 1.06)).isWorse);
}

TEST(Compare, DoesNotJudgeAContinuousFlight) {
    const Json before = {{"mode", "flight"}, {"methods", {{"exact", {{"files_requested", 3}, {"cull_ms", 1.0}}}}}};
    const Comparison flight =
        compared(before, with(before, "/methods/exact", {{"files_requested", 5}, {"cull_ms", 2.0}}));
    EXPECT_FALSE(flight.isWorse);
    EXPECT_EQ(flight.line("exact files_requested"), "exact files_requested 3 5 1.667 changed");
}

TEST(Compare, WarnsOnceOfOtherConditions) {
    const Comparison comparison =
        compared(measurement(), with(with(measurement(), "/database", "mars.osgb"), "/width", 640));
    EXPECT_TRUE(
        comparison.says("warning: not measured alike: database (\"earth.osgb\" and \"mars.osgb\"), "
                        "width (320 and 640)\n"))
        << comparison.text;
}

TEST(Compare, RefusesWhatCannotBeComparedAndNamesABrokenFile) {
    const std::string good = measurement().dump();
    const auto expectRefused = [&](const std::string& place, const Json& value, const std::string& what) {
        expectError(good, with(measurement(), place, value).dump(), what);
    };
    expectRefused("/pose_names", {"a", "c"}, "the poses are not the same");
    expectRefused("/mode", "flight", "the other flew on");
    expectRefused("/methods", {{"paper", {{"drawn_tiles", 1}}}}, "no method is in both");
    for (const char* const place : {"/methods/exact/drawn_tiles", "/methods", "/by_pose"})
        expectRefused(place, "many", "new.json: ");
    expectError(good, "{\"mode\": ", "new.json: is not what");
    expectError("[1, 2]", good, "old.json: is not what");
    std::ostringstream output;
    EXPECT_THROW((void)compareFiles("/nowhere/a.json", "/nowhere/b.json", output), support::Failure);
}

TEST(Compare, TheProgramAnswersWithItsExitCode) {
    const test::TemporaryFolder folder;
    const std::string old = folder.write("old.json", measurement().dump());
    const std::string now = folder.write("new.json", with(measurement(), "/methods/exact/drawn_tiles", 13).dump());
    EXPECT_EQ(test::runBenchBlind({"--compare", old, now}).code, 1);
    EXPECT_EQ(test::runBenchBlind({"--compare", now, old}).code, 0);
    EXPECT_EQ(test::runBenchBlind({"--compare", old, "/nowhere/new.json"}).code, 1);
    EXPECT_EQ(test::runBenchBlind({"--compare", old}).code, 2);
    EXPECT_EQ(test::runBenchBlind({"earth.osgb", "--compare", old, now}).code, 2);
}

}  // namespace
}  // namespace osgAnalyticBin::bench

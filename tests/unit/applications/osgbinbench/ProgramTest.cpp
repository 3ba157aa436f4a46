// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The program on a small paged globe, on a virtual display. Skipped where xvfb-run is not installed.

#include "BenchProgram.h"
#include "Figures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin {
namespace {

using Json = nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;

// The horizon is in view of the third pose, and the other side of the globe below it. The last one sees nothing but the
// limb: the middle of a tile 45 degrees wide, whose corners lie 485 km lower.
constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "oblique,-10,170,800000,-4,178,0,60,10000,8000000\n"
    "narrow,5,5,100000,6,8,0,10,10000,4000000\n"
    "level,5,5,20000,5,15,0,60,2000,4000000\n"
    "limb,-44.6,22.5,10000000,22.5,22.5,110000,2,1000000,30000000\n";

struct Bench {
    TemporaryFolder folder;
    std::string database{test::writeSyntheticDatabase(folder.path())};
    std::string path{folder.write("path.csv", kPath)};

    // Returns: the sums by method; null when the program failed.
    [[nodiscard]] Json run(const std::string& name, const std::string& arguments) const {
        const std::string file = folder / (name + ".json");
        const std::string flush = arguments.find("--flush") == std::string::npos ? " --flush 1" : "";
        const Outcome outcome = test::runBench(test::quoted(database) + " --path " + test::quoted(path) +
                                               " --size 320x240 --repeats 1" + flush + " --json " + test::quoted(file) +
                                               " --csv " + test::quoted(folder / (name + ".csv")) + " " + arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return outcome.code == 0 ? test::jsonFile(file)["methods"] : Json();
    }
};

// Times differ from run to run; nothing else may.
Json withoutTimes(Json methods) {
    for (auto& method : methods) {
        for (const char* const time : {"cull_ms", "cull_spread_ms", "cull_cold_ms", "cull_cold_spread_ms"})
            EXPECT_EQ(method.erase(time), 1U) << time;
    }
    return methods;
}

// The lines of a CSV without its last four columns, the times.
std::vector<std::string> countsOf(const std::string& file) {
    std::istringstream in(test::textOfFile(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        for (int i = 0; i < 4; ++i) line.resize(line.rfind(','));
        lines.push_back(line);
    }
    EXPECT_GT(lines.size(), 1U);
    return lines;
}

TEST(Program, CountsTheSameInEveryRunAndThreadingModel) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    ASSERT_FALSE(bench.database.empty());
    const Json first = withoutTimes(bench.run("first", ""));
    ASSERT_EQ(first.size(), 4U);
    // pictures with bins in every threading model: tests/long/soak
    EXPECT_EQ(first, withoutTimes(bench.run("second", "--threading CullThreadPerCameraDrawThreadPerContext")));
    std::string columns = "pose,method";
    for (const bench::Column& column : bench::kPoseColumns) columns += "," + std::string(column.name);
    EXPECT_EQ(test::textOfFile(bench.folder / "first.csv").find(columns + "\n"), 0U) << "all that the help explains";
    // pose by pose too
    EXPECT_EQ(countsOf(bench.folder / "first.csv"), countsOf(bench.folder / "second.csv"));
}

TEST(Program, JudgesEveryMethodByTheReference) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    ASSERT_FALSE(bench.database.empty());
    const Json methods =
        bench.run("sums",
                  "--methods sphere,cluster,box,orientedbox,orientedbox+horizon+edges,corners,corners+horizon,"
                  "quadratic,quadratic+horizon,exact,exact+horizon+edges,oracle --options horizon=-6000 --pictures " +
                      test::quoted(bench.folder / "pictures"));
    ASSERT_TRUE(methods.contains("none"));
    for (const char* const picture : {"none/oblique.png", "none/limb.png", "exact+horizon+edges/narrow.png"})
        EXPECT_TRUE(std::filesystem::exists(bench.folder / "pictures" + "/" + picture)) << picture;
    const Json& none = methods["none"];
    EXPECT_GT(none["visible_tiles"], 0);
    EXPECT_LE(none["visible_tiles"], none["truth_tiles"]);
    EXPECT_GT(none["hidden_tiles"], 0);
    EXPECT_GE(none["resident_tiles"], none["tested_tiles"]);
    EXPECT_EQ(none["tested_tiles"], none["kept_tiles"]);
    EXPECT_EQ(none["drawn_tiles"].get<int>(), none["false_keeps"].get<int>() + none["truth_tiles"].get<int>());
    EXPECT_EQ(none["triangles"], none["drawn_tiles"].get<int>() * 512);
    for (const char* const sound : {"none", "sphere", "box", "orientedbox", "orientedbox+horizon+edges", "quadratic",
                                    "quadratic+horizon", "exact", "exact+horizon+edges", "oracle"}) {
        EXPECT_EQ(methods[sound]["false_culls"], 0) << sound;
        EXPECT_EQ(methods[sound]["differing_pixels"], 0) << sound;
        EXPECT_GT(methods[sound]["bytes"], 0) << sound;
        EXPECT_GT(methods[sound]["cull_ms"], 0.0) << sound;
        EXPECT_GT(methods[sound]["cull_cold_ms"], 0.0) << sound;
    }
    const auto drawn = [&](const char* name) { return methods[name]["drawn_tiles"].get<int>(); };
    EXPECT_LT(drawn("sphere"), drawn("none"));
    EXPECT_LT(drawn("quadratic"), drawn("sphere"));
    EXPECT_LE(drawn("exact"), drawn("orientedbox"));
    EXPECT_LT(drawn("orientedbox"), drawn("box"));
    EXPECT_LT(drawn("quadratic+horizon"), drawn("quadratic"));
    EXPECT_LT(drawn("corners+horizon"), drawn("corners"));
    EXPECT_LT(drawn("orientedbox+horizon+edges"), drawn("orientedbox"));
    EXPECT_LT(drawn("exact+horizon+edges"), drawn("exact"));
    EXPECT_EQ(drawn("oracle"), drawn("exact+horizon+edges"));
    // A tile that is kept for nothing, as all tiles of its page are culled, is reached, but its page is not.
    EXPECT_EQ(methods["oracle"]["tested_tiles"], methods["exact+horizon+edges"]["kept_tiles"]);
    // The callbacks that the database lacks are made: they cull what is behind the horizon.
    EXPECT_LT(drawn("cluster"), drawn("sphere"));
    EXPECT_LT(methods["quadratic+horizon"]["paged_lods"], methods["sphere"]["paged_lods"]);
    // The unsound method must be caught, by the tiles' own colours and by the picture.
    EXPECT_GT(methods["corners"]["false_culls"], 0);
    EXPECT_GT(methods["corners"]["false_cull_pixels"], 0);
    EXPECT_GT(methods["corners"]["differing_pixels"], 0);
}

TEST(Program, FliesContinuously) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    ASSERT_FALSE(bench.database.empty());
    const Json methods = bench.run("flight", "--frames 30 --frame-rate 15 --methods sphere,oracle");
    ASSERT_EQ(methods.size(), 3U) << "what the oracle repeats flies in its place";
    EXPECT_TRUE(methods.contains("exact+horizon+edges"));
    for (const Json& method : methods) {
        EXPECT_EQ(method["frames"], 30);
        EXPECT_GT(method["files_requested"], 0);
        EXPECT_GT(method["missing_frames"], 0);
        EXPECT_GT(method["resident_tiles"], 32);
        EXPECT_GT(method["drawn_tiles"], 0);
        EXPECT_GT(method["cull_median_ms"], 0.0);
        EXPECT_GE(method["cull_99th_ms"], method["cull_median_ms"]);
    }
}

TEST(Program, TimesTheFramesOfAFlightThatItDraws) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    // its times come some frames late
    const Json methods =
        bench.run("drawn", "--frames 12 --draw --methods sphere,exact --threading DrawThreadPerContext");
    EXPECT_EQ(methods.size(), 2U) << "none is not drawn";
    for (const auto& [name, method] : methods.items()) {
        EXPECT_EQ(method["frames"], 33) << name << ": three flights, without their first frames";
        EXPECT_GT(method["cull_ms"], 0.0) << name;
        EXPECT_GT(method["draw_ms"], 0.0) << name;
        EXPECT_LE(method["work_1st_ms"], method["work_median_ms"]) << name;
        EXPECT_LE(method["work_median_ms"], method["work_99th_ms"]) << name;
        EXPECT_LE(method["frame_median_ms"], method["frame_99th_ms"]) << name;
    }
}

TEST(Program, JumpsAndWaitsUntilNothingIsMissing) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    ASSERT_FALSE(bench.database.empty());
    const Json jumps = bench.run("jumps", "--jumps --methods sphere,exact+horizon");
    const Json poses = bench.run("poses", "--flush 0 --methods sphere,exact+horizon");
    ASSERT_EQ(jumps.size(), 3U);
    for (const auto& [name, method] : jumps.items()) {
        EXPECT_GT(method["missing_frames"], 0) << name;
        EXPECT_GT(method["complete_ms"], 0) << name;
        EXPECT_GT(method["drawn_tiles"], poses[name]["drawn_tiles"]) << name << ": of more frames than poses";
        EXPECT_LE(method["files_requested"], poses[name]["files_requested"]) << name << ": what is there serves again";
    }
}

TEST(Program, FliesAroundADatabaseWithoutAPathAndReports) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    const std::string json = bench.folder / "sums.json", page = bench.folder / "page.html";
    const Outcome outcome =
        test::runBench(test::quoted(bench.database) + " --size 160x90 --repeats 1 --flush 0 --json " +
                       test::quoted(json) + " --report " + test::quoted(page));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.linesWith("osgbinbench: pose 17 of 17, turning_6"), 1) << "progress: " << outcome.text;
    EXPECT_EQ(outcome.linesWith("Bins are worth it for this database"), 1) << outcome.text;
    const Json sums = test::jsonFile(json);
    ASSERT_EQ(sums["paths"].size(), 4U);
    for (const char* const path : {"overview", "oblique", "low", "turning"}) {
        const Json& methods = sums["paths"][path]["methods"];
        EXPECT_GT(methods["none"]["truth_tiles"], 0) << path;
        EXPECT_GT(methods["none"]["visible_tiles"], 0) << path;
        EXPECT_EQ(methods["bins"]["false_culls"], 0) << path;
        EXPECT_LE(methods["bins"]["drawn_tiles"], methods["sphere"]["drawn_tiles"]) << path;
    }
    const std::string html = test::textOfFile(page);
    EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0U);
    EXPECT_EQ(html.find("PARTIAL"), std::string::npos);
    for (const char* const part : {"Bins are worth it", "alt=\"low_1\" src=\"data:image/png;base64,",
                                   "milliseconds a pose", "<svg", "<td class=\"left\">turning</td>", "</html>"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    for (const char* const other : {"src=\"http", "href=\"http", "src=\"/"})
        EXPECT_EQ(html.find(other), std::string::npos) << "one page alone: " << other;
}

TEST(Program, ReportsWhatWasMeasuredBeforeCtrlC) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    const std::string json = bench.folder / "sums.json", page = bench.folder / "page.html";
    const std::string said = test::quoted(bench.folder / "said.txt");
    // the signal comes while the second pose is measured, which would take minutes
    const std::string script = bench.folder.write(
        "interrupted.sh", test::quoted(BENCH_FILE) + " " + test::quoted(bench.database) +
                              " --size 160x90 --repeats 200 --flush 64 --json " + test::quoted(json) + " --report " +
                              test::quoted(page) + " > " + said + " 2>&1 &\n" + "until grep -q 'pose 2 of' " + said +
                              "; do sleep 0.05; done\n" + "kill -INT $!\nwait $!\ncode=$?\ncat " + said +
                              "\nexit $code\n");
    const Outcome outcome = test::runOnDisplay("sh " + test::quoted(script), 300);
    EXPECT_EQ(outcome.code, 130) << outcome.text;
    EXPECT_EQ(outcome.linesWith("PARTIAL RESULT: interrupted after 1 of 17 poses"), 1) << outcome.text;
    const Json sums = test::jsonFile(json);
    EXPECT_EQ(sums["interrupted"], true);
    EXPECT_EQ(sums["poses"], 1);
    EXPECT_NE(test::textOfFile(page).find("PARTIAL RESULT"), std::string::npos);
}

TEST(Program, SaysThatOnlyTerrainCanBeScaled) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const Bench bench;
    const Outcome outcome =
        test::runBench(test::quoted(bench.database) + " --path " + test::quoted(bench.path) + " --vertical-scale 2");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.linesWith("--vertical-scale: "), 1) << outcome.text;
}

}  // namespace
}  // namespace osgAnalyticBin

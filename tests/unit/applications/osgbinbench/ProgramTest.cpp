// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The program on a small paged globe, on a virtual display. Skipped where xvfb-run is not installed.

#include "Bench.h"
#include "BenchProgram.h"

#include <PlanarMap.h>
#include <support/Programs.h>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin {
namespace {

using Json = nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;
using Words = std::vector<std::string>;

// The horizon is in view of the third pose, and the other side of the globe below it. The last one sees nothing but the
// limb: the middle of a tile 45 degrees wide, whose corners lie 485 km lower.
constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "oblique,-10,170,800000,-4,178,0,60,10000,8000000\n"
    "narrow,5,5,100000,6,8,0,10,10000,4000000\n"
    "level,5,5,20000,5,15,0,60,2000,4000000\n"
    "limb,-44.6,22.5,10000000,22.5,22.5,110000,2,1000000,30000000\n";

// Returns: the sums by method; null when the program failed.
Json sumsOf(Words words, const std::string& json, const Words& more) {
    words.insert(words.end(), {"--repeats", "1", "--json", json});
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = test::runBench(words);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return outcome.code == 0 ? test::jsonFile(json)["methods"] : Json();
}

class Program : public testing::Test {
protected:
    void SetUp() override {
        if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
        ASSERT_FALSE(database.empty());
    }

    [[nodiscard]] Json run(const std::string& name, const Words& more) const {
        return sumsOf({database, "--path", path, "--size", "320x240", "--csv", folder / (name + ".csv")},
                      folder / (name + ".json"), more);
    }

    const TemporaryFolder folder;
    const std::string database = test::writeSyntheticDatabase(folder.path());
    const std::string path = folder.write("path.csv", kPath);
    const std::string json = folder / "sums.json";
    const std::string page = folder / "page.html";
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
Words countsOf(const std::string& file) {
    std::istringstream in(test::textOfFile(file));
    Words lines;
    for (std::string line; std::getline(in, line);) {
        for (int i = 0; i < 4; ++i) line.resize(line.rfind(','));
        lines.push_back(line);
    }
    EXPECT_GT(lines.size(), 1U);
    return lines;
}

TEST_F(Program, CountsTheSameInEveryRunAndThreadingModel) {
    const Json first = withoutTimes(run("first", {"--flush", "1"}));
    ASSERT_EQ(first.size(), 4U);
    // pictures with bins in every threading model: tests/long/soak
    EXPECT_EQ(first,
              withoutTimes(run("second", {"--flush", "1", "--threading", "CullThreadPerCameraDrawThreadPerContext"})));
    std::string columns = "pose,method";
    for (const bench::Column& column : bench::kPoseColumns) columns += "," + std::string(column.name);
    EXPECT_EQ(test::textOfFile(folder / "first.csv").find(columns + "\n"), 0U) << "all that the help explains";
    // pose by pose too
    EXPECT_EQ(countsOf(folder / "first.csv"), countsOf(folder / "second.csv"));
}

TEST_F(Program, JudgesEveryMethodByTheReference) {
    const Json methods =
        run("sums", {"--methods",
                     "sphere,cluster,box,orientedbox,orientedbox+horizon+edges,corners,corners+horizon,"
                     "quadratic,quadratic+horizon,exact,exact+horizon+edges,oracle",
                     "--flush", "1", "--options", "horizon=-6000", "--pictures", folder / "pictures"});
    ASSERT_TRUE(methods.contains("none"));
    for (const char* const picture : {"none/oblique.png", "none/limb.png", "exact+horizon+edges/narrow.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / "pictures" + "/" + picture)) << picture;
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
        for (const char* const wrong : {"false_culls", "differing_pixels"})
            EXPECT_EQ(methods[sound][wrong], 0) << sound << ' ' << wrong;
        for (const char* const measured : {"bytes", "cull_ms", "cull_cold_ms"})
            EXPECT_GT(methods[sound][measured], 0) << sound << ' ' << measured;
    }
    const auto drawn = [&](const char* name) { return methods[name]["drawn_tiles"].get<int>(); };
    // The callbacks that the database lacks are made for "cluster": they cull what is behind the horizon.
    for (const auto& [fewer, more] : {std::pair("sphere", "none"),
                                      {"cluster", "sphere"},
                                      {"quadratic", "sphere"},
                                      {"orientedbox", "box"},
                                      {"quadratic+horizon", "quadratic"},
                                      {"corners+horizon", "corners"},
                                      {"orientedbox+horizon+edges", "orientedbox"},
                                      {"exact+horizon+edges", "exact"}})
        EXPECT_LT(drawn(fewer), drawn(more)) << fewer;
    EXPECT_LE(drawn("exact"), drawn("orientedbox"));
    EXPECT_EQ(drawn("oracle"), drawn("exact+horizon+edges"));
    // A tile that is kept for nothing, as all tiles of its page are culled, is reached, but its page is not.
    EXPECT_EQ(methods["oracle"]["tested_tiles"], methods["exact+horizon+edges"]["kept_tiles"]);
    EXPECT_LT(methods["quadratic+horizon"]["paged_lods"], methods["sphere"]["paged_lods"]);
    // The unsound method must be caught, by the tiles' own colours and by the picture.
    for (const char* const wrong : {"false_culls", "false_cull_pixels", "differing_pixels"})
        EXPECT_GT(methods["corners"][wrong], 0) << wrong;
}

TEST_F(Program, FliesContinuously) {
    const Json methods = run("flight", {"--frames", "30", "--frame-rate", "15", "--methods", "sphere,oracle"});
    ASSERT_EQ(methods.size(), 3U) << "what the oracle repeats flies in its place";
    EXPECT_TRUE(methods.contains("exact+horizon+edges"));
    for (const Json& method : methods) {
        EXPECT_EQ(method["frames"], 30);
        EXPECT_GT(method["resident_tiles"], 32);
        for (const char* const counted : {"files_requested", "missing_frames", "drawn_tiles", "cull_median_ms"})
            EXPECT_GT(method[counted], 0) << counted;
        EXPECT_GE(method["cull_99th_ms"], method["cull_median_ms"]);
    }
    const Json ahead = run("ahead", {"--frames", "12", "--speed", "10", "--methods", "sphere"});
    EXPECT_EQ(ahead["sphere"]["missing_frames"], 0) << "each flight begins with all that it shows";
    // the times of frames that are drawn come some frames late
    const Json drawn =
        run("drawn", {"--frames", "12", "--draw", "--methods", "sphere,exact", "--threading", "DrawThreadPerContext"});
    EXPECT_EQ(drawn.size(), 2U) << "none is not drawn";
    for (const auto& [name, method] : drawn.items()) {
        EXPECT_EQ(method["frames"], 36) << name << ": three flights";
        EXPECT_GT(method["cull_ms"], 0.0) << name;
        EXPECT_GT(method["draw_ms"], 0.0) << name;
        EXPECT_LE(method["work_1st_ms"], method["work_median_ms"]) << name;
        EXPECT_LE(method["work_median_ms"], method["work_99th_ms"]) << name;
        EXPECT_LE(method["frame_median_ms"], method["frame_99th_ms"]) << name;
    }
}

TEST_F(Program, JumpsAndWaitsUntilNothingIsMissing) {
    const Json jumps = run("jumps", {"--jumps", "--methods", "sphere,exact+horizon"});
    const Json poses = run("poses", {"--flush", "0", "--methods", "sphere,exact+horizon"});
    ASSERT_EQ(jumps.size(), 3U);
    for (const auto& [name, method] : jumps.items()) {
        EXPECT_GT(method["missing_frames"], 0) << name;
        EXPECT_GT(method["complete_ms"], 0) << name;
        EXPECT_GT(method["drawn_tiles"], poses[name]["drawn_tiles"]) << name << ": of more frames than poses";
        EXPECT_LE(method["files_requested"], poses[name]["files_requested"]) << name << ": what is there serves again";
    }
}

// That nothing in view is culled on a map: tests/scenes/map.scene.
TEST_F(Program, FliesAroundAGlobeOrAMapWithoutAPathAndReports) {
    const std::string map = folder / "map.osgb";
    ASSERT_TRUE(osgDB::writeNodeFile(*test::PlanarMap().build(folder.path()), map));
    for (const std::string& file : {map, database}) {
        const Outcome outcome = test::runBench(
            {file, "--size", "160x90", "--repeats", "1", "--flush", "0", "--json", json, "--report", page});
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        const Json paths = test::jsonFile(json)["paths"];
        ASSERT_EQ(paths.size(), 4U);
        for (const char* const each : {"overview", "oblique", "low", "turning"}) {
            const Json& methods = paths[each]["methods"];
            EXPECT_GT(methods["none"]["truth_tiles"], 0) << each;
            EXPECT_GT(methods["none"]["visible_tiles"], 0) << each;
            EXPECT_EQ(methods["bins"]["false_culls"], 0) << each;
            EXPECT_LE(methods["bins"]["drawn_tiles"], methods["sphere"]["drawn_tiles"]) << each;
        }
        if (file == map) continue;
        EXPECT_EQ(outcome.linesWith("osgbinbench: pose 17 of 17, turning_6"), 1) << "progress: " << outcome.text;
        EXPECT_EQ(outcome.linesWith("Bins are worth it for this database"), 1) << outcome.text;
    }
    const std::string html = test::textOfFile(page);
    EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0U);
    for (const char* const part : {"Bins are worth it", "alt=\"low_1\" src=\"data:image/png;base64,",
                                   "milliseconds a pose", "<svg", "<td class=\"left\">turning</td>", "</html>"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    for (const char* const other : {"PARTIAL", "src=\"http", "href=\"http", "src=\"/"})
        EXPECT_EQ(html.find(other), std::string::npos) << "one page alone: " << other;
}

TEST_F(Program, ReportsWhatWasMeasuredBeforeCtrlC) {
    const std::string said = folder / "said.txt";
    // the signal comes while the second pose is measured, which would take minutes
    const std::string bench = test::benchCommand(
        {database, "--size", "160x90", "--repeats", "200", "--flush", "64", "--json", json, "--report", page});
    const std::string command = test::interrupted(bench + " >" + said + " 2>&1", "grep -q pose.2.of " + said, ":");
    EXPECT_EQ(test::runOnDisplay(command, 300).code, 130) << test::textOfFile(said);
    EXPECT_NE(test::textOfFile(said).find("PARTIAL RESULT: interrupted after 1 of 17 poses"), std::string::npos);
    const Json sums = test::jsonFile(json);
    EXPECT_EQ(sums["interrupted"], true);
    EXPECT_EQ(sums["poses"], 1);
    EXPECT_NE(test::textOfFile(page).find("PARTIAL RESULT"), std::string::npos);
}

// One line, a code other than zero, and no files.
TEST_F(Program, SaysWhatIsWrong) {
    const std::string broken = folder.write("broken.csv", std::string(kPath) + "low,20,30,abc,20,30,0,40,1,2\n");
    const auto expectError = [](const Outcome& outcome, const std::string& what) {
        EXPECT_EQ(outcome.code, 1);
        EXPECT_EQ(outcome.linesWith(what), 1) << outcome.text;
    };
    expectError(test::runBenchBlind({"x.osgb", "--path", broken}), "osgbinbench: " + broken + ":6: eyeAlt");
    expectError(test::runBenchBlind({"x.osgb", "--path", path}), "no display");
    const Outcome absent = test::runBench({folder / "absent.osgb", "--path", path, "--csv", folder / "poses.csv"});
    expectError(absent, "absent.osgb: cannot be read");
    EXPECT_LE(absent.linesWith(""), 2) << absent.text;  // progress, then what went wrong
    EXPECT_FALSE(std::filesystem::exists(folder / "poses.csv"));
    expectError(test::runBench({database, "--path", path, "--vertical-scale", "2"}), "--vertical-scale: ");
}

// Databases of VirtualPlanetBuilder, and a camera path for one of them. Skipped where the samples are absent.
class Vpb : public testing::Test {
protected:
    void SetUp() override {
        if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
        if (!std::filesystem::exists(databaseOf("terrain"))) GTEST_SKIP() << "needs " << SAMPLE_DATA;
    }
    static std::string databaseOf(const std::string& mode) { return SAMPLE_DATA "/vpb/" + mode + "/earth.osgb"; }
    [[nodiscard]] Json run(const std::string& mode, const std::string& path, const Words& more) const {
        return sumsOf({databaseOf(mode), "--path", path, "--flush", "0"}, folder / "sums.json", more);
    }
    static void expectNothingLost(const Json& method) {
        for (const char* const wrong : {"false_culls", "differing_pixels"}) EXPECT_EQ(method[wrong], 0) << wrong;
    }

    const TemporaryFolder folder;
};

TEST_F(Vpb, StockMethodsDifferInWhatTheyDrawAndAskFor) {
    const std::string path =
        folder.write("p.csv",
                     "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
                     "oblique,58,-20,100000,59,-19,0,60,20000,2000000\n"
                     "level,58,-20,9000,62,-19,3000,60,500,700000\n");
    for (const char* const mode : {"terrain", "polygonal"}) {
        const Json methods = run(mode, path, {"--methods", "sphere,cluster", "--size", "320x240"});
        for (const char* const key : {"drawn_tiles", "triangles", "paged_lods", "files_requested", "bytes"}) {
            // Nothing but the cluster callbacks, those of later pages among them, tells sphere and cluster apart.
            EXPECT_LT(methods["sphere"][key], methods["none"][key]) << mode << ' ' << key;
            EXPECT_LT(methods["cluster"][key], methods["sphere"][key]) << mode << ' ' << key;
        }
        expectNothingLost(methods["sphere"]);
        EXPECT_LE(methods["none"]["visible_tiles"], methods["none"]["truth_tiles"]);
    }
}

TEST_F(Vpb, ClusterCallbacksCullWhatIsSeenOfExaggeratedTerrainAndBinsDoNot) {
    const Json methods =
        run("terrain", VPB_EXAGGERATED_PATH_FILE,
            {"--vertical-scale", "10", "--methods", "cluster,exact+horizon+edges", "--size", "640x360"});
    EXPECT_GE(methods["cluster"]["false_culls"], 5);
    EXPECT_GE(methods["cluster"]["differing_pixels"], 500);
    expectNothingLost(methods["exact+horizon+edges"]);
}

TEST_F(Vpb, PicturesWithBinsAreThoseWithoutCulling) {
    const Json methods = run("polygonal", VPB_EXAGGERATED_PATH_FILE,
                             {"--methods", "bins", "--size", "480x270", "--threading", "DrawThreadPerContext"});
    expectNothingLost(methods["bins"]);
    EXPECT_LT(methods["bins"]["drawn_tiles"].get<double>(), 0.3 * methods["none"]["drawn_tiles"].get<double>());
}

}  // namespace
}  // namespace osgAnalyticBin

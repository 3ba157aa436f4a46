// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases of VirtualPlanetBuilder, and the camera path that was made for them. Skipped where the samples are absent.

#include "BenchProgram.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin {
namespace {

using test::TemporaryFolder;

constexpr const char* kSamplePath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "oblique,58,-20,100000,59,-19,0,60,20000,2000000\n"
    "level,58,-20,9000,62,-19,3000,60,500,700000\n";

class VpbSample : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        database = std::string(SAMPLE_DATA) + "/vpb/" + GetParam() + "/earth.osgb";
        if (!std::filesystem::exists(database)) GTEST_SKIP() << "needs " << database;
        if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    }

    std::string database;
};

TEST_P(VpbSample, StockMethodsDifferInWhatTheyDrawAndAskFor) {
    const TemporaryFolder folder;
    const std::string file = folder / "sums.json";
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --path " + test::quoted(folder.write("p.csv", kSamplePath)) +
                       " --methods sphere,cluster --size 320x240 --repeats 1 --flush 0 --json " + test::quoted(file));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json methods = test::jsonFile(file)["methods"];
    for (const char* const key : {"drawn_tiles", "triangles", "paged_lods", "files_requested", "bytes"}) {
        // Nothing but the cluster callbacks, those of later pages among them, tells sphere and cluster apart.
        EXPECT_LT(methods["sphere"][key], methods["none"][key]) << key;
        EXPECT_LT(methods["cluster"][key], methods["sphere"][key]) << key;
    }
    EXPECT_EQ(methods["sphere"]["false_culls"], 0);
    EXPECT_EQ(methods["sphere"]["differing_pixels"], 0);
    EXPECT_LE(methods["none"]["visible_tiles"], methods["none"]["truth_tiles"]);
}

INSTANTIATE_TEST_SUITE_P(Modes, VpbSample, testing::Values("terrain", "polygonal"),
                         [](const auto& mode) { return std::string(mode.param); });

struct PictureCase {
    const char* mode;
    const char* threading;
    int scale;
};

std::ostream& operator<<(std::ostream& out, const PictureCase& each) {
    return out << each.mode << " x" << each.scale << ' ' << each.threading;
}

// Every fourth pose of the path; with exaggerated mountains eyes below 30 km are lifted above them.
std::string shortPath(int scale) {
    constexpr std::size_t kAltitude = 3, kNear = 8, kFar = 9;
    std::ifstream in(VPB_PATH_FILE);
    std::string text;
    int poses = 0;
    for (std::string line; std::getline(in, line);) {
        const bool isHead = line.rfind('#', 0) == 0 || line.rfind("name", 0) == 0;
        if (!isHead && poses++ % 4 != 0) continue;
        std::vector<std::string> cells;
        std::istringstream parts(line);
        for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
        if (!isHead && scale > 1 && std::stod(cells[kAltitude]) < 30000.0) {
            cells[kAltitude] = "30000";
            cells[kNear] = "750";
            cells[kFar] = "1600000";
        }
        for (std::size_t i = 0; i < cells.size(); ++i) text += (i ? "," : "") + cells[i];
        text += '\n';
    }
    return text;
}

class VpbPictures : public testing::TestWithParam<PictureCase> {};

TEST_P(VpbPictures, WithBinsAreThoseWithoutCulling) {
    const std::string database = std::string(SAMPLE_DATA) + "/vpb/" + GetParam().mode + "/earth.osgb";
    if (!std::filesystem::exists(database)) GTEST_SKIP() << "needs " << database;
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const TemporaryFolder folder;
    const std::string file = folder / "sums.json";
    const std::string path = folder.write("p.csv", shortPath(GetParam().scale));
    const test::Outcome outcome = test::runBench(
        test::quoted(database) + " --path " + test::quoted(path) + " --methods exact+horizon+edges --size 480x270" +
        " --repeats 1 --flush 0 --threading " + GetParam().threading + " --vertical-scale " +
        std::to_string(GetParam().scale) + " --json " + test::quoted(file));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json sums = test::jsonFile(file);
    EXPECT_GE(sums["poses"], 12);
    const nlohmann::json& exact = sums["methods"]["exact+horizon+edges"];
    EXPECT_EQ(exact["differing_pixels"], 0);
    EXPECT_EQ(exact["false_culls"], 0);
    EXPECT_LT(exact["drawn_tiles"].get<double>(), 0.12 * sums["methods"]["none"]["drawn_tiles"].get<double>());
}

// Threads differ in when they cull, not in what: the soak test compares pictures in every threading model.
std::vector<PictureCase> pictureCases() {
    return {{"terrain", "SingleThreaded", 1},
            {"terrain", "CullThreadPerCameraDrawThreadPerContext", 3},
            {"polygonal", "DrawThreadPerContext", 1}};
}

INSTANTIATE_TEST_SUITE_P(Cases, VpbPictures, testing::ValuesIn(pictureCases()), [](const auto& each) {
    return std::string(each.param.mode) + std::to_string(each.param.scale) + each.param.threading;
});

TEST(VpbExaggerated, ClusterCallbacksCullWhatIsSeenAndBinsDoNot) {
    const std::string database = std::string(SAMPLE_DATA) + "/vpb/terrain/earth.osgb";
    if (!std::filesystem::exists(database)) GTEST_SKIP() << "needs " << database;
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const TemporaryFolder folder;
    const std::string file = folder / "sums.json";
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --path " + test::quoted(VPB_EXAGGERATED_PATH_FILE) +
                       " --vertical-scale 10 --methods cluster,exact+horizon+edges --size 640x360 --repeats 1 "
                       "--flush 0 --json " +
                       test::quoted(file));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json methods = test::jsonFile(file)["methods"];
    EXPECT_GE(methods["cluster"]["false_culls"], 5);
    EXPECT_GE(methods["cluster"]["differing_pixels"], 500);
    EXPECT_EQ(methods["exact+horizon+edges"]["false_culls"], 0);
    EXPECT_EQ(methods["exact+horizon+edges"]["differing_pixels"], 0);
}

}  // namespace
}  // namespace osgAnalyticBin

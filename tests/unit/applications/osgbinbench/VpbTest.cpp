// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases of VirtualPlanetBuilder, and a camera path that was made for one of them. Skipped where the samples are
// absent.

#include "BenchProgram.h"

#include <gtest/gtest.h>

#include <filesystem>
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

class Vpb : public testing::Test {
protected:
    void SetUp() override {
        if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
        if (!std::filesystem::exists(databaseOf("terrain"))) GTEST_SKIP() << "needs " << SAMPLE_DATA;
    }
    static std::string databaseOf(const std::string& mode) { return SAMPLE_DATA "/vpb/" + mode + "/earth.osgb"; }

    // Returns: the sums.
    [[nodiscard]] nlohmann::json run(const std::string& mode, const std::string& path,
                                     const std::vector<std::string>& more) const {
        std::vector<std::string> words{databaseOf(mode), "--path", path,     "--repeats",         "1",
                                       "--flush",        "0",      "--json", folder / "sums.json"};
        words.insert(words.end(), more.begin(), more.end());
        const test::Outcome outcome = test::runBench(words);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return test::jsonFile(folder / "sums.json");
    }

    static void expectNothingLost(const nlohmann::json& method) {
        EXPECT_EQ(method["false_culls"], 0);
        EXPECT_EQ(method["differing_pixels"], 0);
    }

    const TemporaryFolder folder;
};

TEST_F(Vpb, StockMethodsDifferInWhatTheyDrawAndAskFor) {
    const std::string path = folder.write("p.csv", kSamplePath);
    for (const char* const mode : {"terrain", "polygonal"}) {
        const nlohmann::json methods = run(mode, path, {"--methods", "sphere,cluster", "--size", "320x240"})["methods"];
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
    const nlohmann::json methods =
        run("terrain", VPB_EXAGGERATED_PATH_FILE,
            {"--vertical-scale", "10", "--methods", "cluster,exact+horizon+edges", "--size", "640x360"})["methods"];
    EXPECT_GE(methods["cluster"]["false_culls"], 5);
    EXPECT_GE(methods["cluster"]["differing_pixels"], 500);
    expectNothingLost(methods["exact+horizon+edges"]);
}

}  // namespace
}  // namespace osgAnalyticBin

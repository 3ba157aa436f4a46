// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases of VirtualPlanetBuilder, and the camera path that was made for them. Skipped where the samples are absent.

#include "BenchProgram.h"
#include "CameraPath.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::TemporaryFolder;

constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "oblique,58,-20,100000,59,-19,0,60,20000,2000000\n"
    "level,58,-20,9000,62,-19,3000,60,500,700000\n";

class VpbSample : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        database = std::string(SHARED_DATA) + "/vpb/" + GetParam() + "/earth.osgb";
        if (!std::filesystem::exists(database)) GTEST_SKIP() << "needs " << database;
        if (!test::canRunBench()) GTEST_SKIP() << "needs xvfb-run";
    }

    std::string database;
};

TEST_P(VpbSample, StockMethodsDifferInWhatTheyDrawAndAskFor) {
    const TemporaryFolder folder;
    const std::string file = folder / "sums.json";
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --path " + test::quoted(folder.write("p.csv", kPath)) +
                       " --methods sphere,cluster --size 320x240 --repeats 1 --json " + test::quoted(file));
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

TEST(VpbPath, HasPosesOfEveryKind) {
    std::string error;
    const auto path = flight::readCameraPathFile(VPB_PATH_FILE, error);
    ASSERT_TRUE(path.has_value()) << error;
    EXPECT_GE(path->size(), 48U);
    for (const char* const kind : {"fov60_nadir", "fov60_oblique", "fov60_horizon", "fov60_pole", "fov60_dateline",
                                   "fov10_nadir", "fov10_oblique", "fov10_horizon", "fov2_oblique", "fov2_horizon"}) {
        std::size_t poses = 0;
        for (const flight::CameraPose& pose : *path) poses += pose.name.rfind(kind, 0) == 0 ? 1U : 0U;
        EXPECT_GE(poses, 1U) << kind;
    }
}

}  // namespace
}  // namespace osgAnalyticBin

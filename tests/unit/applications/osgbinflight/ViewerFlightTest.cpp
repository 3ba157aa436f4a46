// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer flies over a small paged globe, on a virtual display. Oracle: the pictures of the flight that
// culls nothing. Skipped where xvfb-run or osgviewer is not installed.

#include "Report.h"

#include <gtest/gtest.h>

#include <support/Programs.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using bench::Measurement;
using bench::readFlights;
using test::TemporaryFolder;

constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "down,20,30,10000000,20,30,0,40,1000000,20000000\n"
    "oblique_1,-10,170,800000,-4,178,0,60,10000,8000000\n"
    "oblique_2,75,-60,600000,80,-40,0,60,10000,8000000\n"
    "narrow,5,5,100000,6,8,0,10,10000,4000000\n";
constexpr std::size_t kPoses = 4;

class ViewerFlight : public testing::Test {
protected:
    void SetUp() override {
        if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
        ASSERT_FALSE(database.empty());
    }

    // Returns: the folder of the pictures.
    std::string fly(const std::string& method, const std::string& threading = "SingleThreaded",
                    const std::string& parameters = "frames=3") {
        return flyOver(database + ".(method=" + method + ").analyticbin", method + "-" + threading, threading,
                       parameters);
    }

    std::string flyOver(const std::string& scene, const std::string& name, const std::string& threading,
                        const std::string& parameters) {
        const std::string out = folder / name;
        const test::Outcome outcome =
            test::runViewer("--" + threading + ' ' + test::quoted(scene) + ' ' +
                                test::quoted(path + ".(out=" + out + "," + parameters + ").binflight"),
                            test::Modules::Present, "OSG_NOTIFY_LEVEL=NOTICE");
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        lastLog = outcome.text;
        return out;
    }

    const TemporaryFolder folder;
    const std::string database = test::writeSyntheticDatabase(folder.path());
    const std::string path = folder.write("path.csv", kPath);
    std::string lastLog;
};

void expectEqualPictures(const Measurement& flown) {
    for (const std::string& mismatch : mismatchesOf(flown)) ADD_FAILURE() << mismatch;
}

std::uint64_t sumOf(const Measurement& flown, std::size_t method, const char* column) {
    return sumOf(flown.methods[method], allOf(flown.methods[method]))[column].get<std::uint64_t>();
}

// What does not depend on how well a method culls.
void expectPlausible(const bench::MethodFigures& flown) {
    for (const report::Json& row : flown.rows) {
        const auto at = [&](const char* column) { return row[column].get<double>(); };
        EXPECT_GE(at("tested_tiles"), 32.0) << row;
        EXPECT_GE(at("tested_tiles"), at("kept_tiles")) << row;
        EXPECT_GE(at("kept_tiles"), at("drawn_tiles")) << row;
        EXPECT_GT(at("drawn_tiles"), 0.0) << row;
        EXPECT_EQ(at("drawables"), at("drawn_tiles")) << row;
        EXPECT_EQ(at("triangles"), at("drawn_tiles") * 512.0) << row;
        EXPECT_GT(at("cull_ms"), 0.0) << row;
        EXPECT_GT(at("frame_ms"), at("cull_ms")) << row;
    }
}

TEST_F(ViewerFlight, EveryMethodAndThreadingModelDrawsTheSamePictures) {
    const Measurement flown = readFlights(
        {fly("none"), fly("sphere"), fly("quadratic"), fly("quadratic", "CullDrawThreadPerContext"),
         fly("quadratic", "DrawThreadPerContext"), fly("quadratic", "CullThreadPerCameraDrawThreadPerContext")});
    expectEqualPictures(flown);
    ASSERT_EQ(flown.poses.size(), kPoses);
    for (std::size_t i = 0; i < flown.methods.size(); ++i) {
        if (i < 3) expectPlausible(flown.methods[i]);
        for (std::size_t pose = 0; i > 2 && pose < kPoses; ++pose)
            EXPECT_EQ(flown.methods[i].rows[pose]["drawn_tiles"], flown.methods[2].rows[pose]["drawn_tiles"]) << i;
    }
    EXPECT_EQ(sumOf(flown, 0, "tested_tiles"), sumOf(flown, 0, "kept_tiles"));
    EXPECT_GT(sumOf(flown, 0, "drawn_tiles"), sumOf(flown, 1, "drawn_tiles"));
    EXPECT_GT(sumOf(flown, 1, "kept_tiles"), sumOf(flown, 2, "kept_tiles"));
    EXPECT_GE(sumOf(flown, 0, "files_requested"), sumOf(flown, 2, "files_requested"));
    EXPECT_GT(sumOf(flown, 2, "files_requested"), 0U);
}

TEST_F(ViewerFlight, AStoredDatabaseNeedsNothingButTheModules) {
    const std::string plain = flyOver(database, "plain", "SingleThreaded", "frames=1");
    const Measurement flown = readFlights({fly("none"), fly("sphere"), plain});
    expectEqualPictures(flown);
    EXPECT_LT(sumOf(flown, 2, "kept_tiles"), sumOf(flown, 1, "kept_tiles"));
}

TEST_F(ViewerFlight, AFileThatIsMissingIsAnErrorWithoutATable) {
    for (const auto& file : std::filesystem::directory_iterator(folder.path()))
        if (file.path().filename().string().rfind("tiles_", 0) == 0) std::filesystem::remove(file);
    const std::string out = fly("quadratic", "SingleThreaded", "frames=1,timeout=3");
    EXPECT_FALSE(std::filesystem::exists(out + "/poses.csv"));
    EXPECT_NE(lastLog.find("binflight: "), std::string::npos) << lastLog;
    EXPECT_NE(lastLog.find("after 3 s"), std::string::npos) << lastLog;
}

}  // namespace
}  // namespace osgAnalyticBin

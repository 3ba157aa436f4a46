// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer flies over a small paged globe, on a virtual display. Oracle: the pictures of the flight that
// culls nothing. Skipped where xvfb-run or osgviewer is not installed.

#include "Report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using report::Flight;
using report::readFlights;
using report::sumOf;
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

void expectEqualPictures(const std::vector<Flight>& flights) {
    for (const report::Mismatch& mismatch : mismatchesOf(flights))
        ADD_FAILURE() << mismatch.label << " at " << mismatch.pose << ": " << mismatch.pixels << " pixels";
}

// What does not depend on how well a method culls.
void expectPlausible(const Flight& run) {
    for (std::size_t i = 0; i < run.poses.size(); ++i) {
        const auto at = [&](const char* column) { return run.figures.rows[i][column].get<double>(); };
        EXPECT_GE(at("tilesTested"), 32.0) << run.poses[i];
        EXPECT_GE(at("tilesTested"), at("tilesKept")) << run.poses[i];
        EXPECT_GE(at("tilesKept"), at("tilesDrawn")) << run.poses[i];
        EXPECT_GT(at("tilesDrawn"), 0.0) << run.poses[i];
        EXPECT_EQ(at("drawables"), at("tilesDrawn")) << run.poses[i];
        EXPECT_EQ(at("triangles"), at("tilesDrawn") * 512.0) << run.poses[i];
        EXPECT_GT(at("cullMs"), 0.0) << run.poses[i];
        EXPECT_GT(at("frameMs"), at("cullMs")) << run.poses[i];
    }
}

// The census is a visitor of its own class, for which OSG's spheres cull before bins are asked: whatever they leave is
// tested by its bin.
void expectTestedByBins(const Flight& run) {
    EXPECT_LE(sumOf(run.figures)["binsTested"], sumOf(run.figures)["tilesTested"]);
    EXPECT_GE(sumOf(run.figures)["binsTested"], sumOf(run.figures)["tilesKept"]);
}

TEST_F(ViewerFlight, EveryMethodAndThreadingModelDrawsTheSamePictures) {
    const std::vector<Flight> flown = readFlights(
        {fly("none"), fly("sphere"), fly("quadratic"), fly("quadratic", "CullDrawThreadPerContext"),
         fly("quadratic", "DrawThreadPerContext"), fly("quadratic", "CullThreadPerCameraDrawThreadPerContext")},
        "");
    expectEqualPictures(flown);
    for (std::size_t i = 0; i < flown.size(); ++i) {
        ASSERT_EQ(flown[i].poses.size(), kPoses);
        if (i < 3) expectPlausible(flown[i]);
        for (std::size_t pose = 0; i > 2 && pose < kPoses; ++pose)
            EXPECT_EQ(flown[i].figures.rows[pose]["tilesDrawn"], flown[2].figures.rows[pose]["tilesDrawn"]) << i;
    }
    auto none = sumOf(flown[0].figures), sphere = sumOf(flown[1].figures), quadratic = sumOf(flown[2].figures);
    EXPECT_EQ(none["tilesTested"], none["tilesKept"]);
    EXPECT_GT(none["tilesDrawn"], sphere["tilesDrawn"]);
    EXPECT_GT(sphere["tilesKept"], quadratic["tilesKept"]);
    EXPECT_GE(none["files"], quadratic["files"]);
    EXPECT_GT(quadratic["files"], 0.0);
    expectTestedByBins(flown[2]);
    EXPECT_EQ(sphere["binsTested"], 0.0);
}

TEST_F(ViewerFlight, AStoredDatabaseNeedsNothingButTheModules) {
    const std::string plain = flyOver(database, "plain", "SingleThreaded", "frames=1");
    const std::vector<Flight> flown = readFlights({fly("none"), plain}, "");
    expectEqualPictures(flown);
    expectTestedByBins(flown[1]);
    EXPECT_LT(sumOf(flown[1].figures)["tilesKept"], sumOf(flown[0].figures)["tilesKept"]);
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

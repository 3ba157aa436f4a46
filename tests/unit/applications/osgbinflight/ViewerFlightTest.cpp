// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer flies over a small paged globe, on a virtual display. Oracle: the pictures of the flight that
// culls nothing. Skipped where xvfb-run or osgviewer is not installed.

#include "PoseTable.h"
#include "Report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
namespace osgAnalyticBin {
namespace {

using flight::PoseRecord;
using report::Flight;
using report::Report;
using test::TemporaryFolder;

constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "down,20,30,10000000,20,30,0,40,1000000,20000000\n"
    "oblique_1,-10,170,800000,-4,178,0,60,10000,8000000\n"
    "oblique_2,75,-60,600000,80,-40,0,60,10000,8000000\n"
    "narrow,5,5,100000,6,8,0,10,10000,4000000\n";
constexpr std::size_t kPoses = 4;

struct Flights {
    TemporaryFolder folder;
    std::string database;
    std::string path;

    Flights() : database(test::writeSyntheticDatabase(folder.path())), path(folder.write("path.csv", kPath)) {}

    // Returns: the folder of the pictures.
    [[nodiscard]] std::string fly(const std::string& method, const std::string& threading,
                                  const std::string& parameters = "frames=3") const {
        return flyOver(database + ".(method=" + method + ").analyticbin", method + "-" + threading, threading,
                       parameters);
    }

    [[nodiscard]] std::string flyOver(const std::string& scene, const std::string& name, const std::string& threading,
                                      const std::string& parameters) const {
        const std::string out = folder / name;
        const test::Outcome outcome =
            test::runViewer("--" + threading + ' ' + test::quoted(scene) + ' ' +
                                test::quoted(path + ".(out=" + out + "," + parameters + ").binflight"),
                            test::Modules::Present, "OSG_NOTIFY_LEVEL=NOTICE");
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        lastLog = outcome.text;
        return out;
    }

    mutable std::string lastLog;
};

void expectEqualPictures(const Report& report) {
    for (const report::Mismatch& mismatch : report.mismatches())
        ADD_FAILURE() << mismatch.label << " at " << mismatch.pose << ": " << mismatch.pixels << " pixels";
}

// What does not depend on how well a method culls.
void expectPlausible(const PoseRecord& pose) {
    EXPECT_GE(pose.tiles.tested, 32u) << pose.name;
    EXPECT_GE(pose.tiles.tested, pose.tiles.kept) << pose.name;
    EXPECT_GE(pose.tiles.kept, pose.tiles.drawn) << pose.name;
    EXPECT_GT(pose.tiles.drawn, 0u) << pose.name;
    EXPECT_EQ(pose.tiles.drawables, pose.tiles.drawn) << pose.name;
    EXPECT_EQ(pose.tiles.triangles, pose.tiles.drawn * 512u) << pose.name;
    EXPECT_GT(pose.cullMs, 0.0) << pose.name;
    EXPECT_GT(pose.frameMs, pose.cullMs) << pose.name;
}

std::uint64_t sumOf(const Flight& run, std::uint64_t flight::TileCounts::*count) {
    std::uint64_t sum = 0;
    for (const PoseRecord& pose : run.poses) sum += pose.tiles.*count;
    return sum;
}

std::uint64_t filesOf(const Flight& run) {
    std::uint64_t sum = 0;
    for (const PoseRecord& pose : run.poses) sum += pose.files;
    return sum;
}

// The census is a visitor of its own class, for which OSG's spheres cull before bins are asked: whatever they leave is
// tested by its bin.
void expectTestedByBins(const Flight& run) {
    EXPECT_LE(sumOf(run, &flight::TileCounts::binsTested), sumOf(run, &flight::TileCounts::tested));
    EXPECT_GE(sumOf(run, &flight::TileCounts::binsTested), sumOf(run, &flight::TileCounts::kept));
}

TEST(ViewerFlight, EveryMethodDrawsTheSamePictures) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    std::string error;
    const auto report = Report::of({flights.fly("none", "SingleThreaded"), flights.fly("sphere", "SingleThreaded"),
                                    flights.fly("quadratic", "SingleThreaded")},
                                   {"none", "sphere", "quadratic"}, "", error);
    ASSERT_TRUE(report.has_value()) << error << '\n' << flights.lastLog;
    expectEqualPictures(*report);
    for (const Flight& run : report->runs()) {
        ASSERT_EQ(run.poses.size(), kPoses);
        std::for_each(run.poses.begin(), run.poses.end(), expectPlausible);
    }
    const Flight& none = report->runs()[0];
    const Flight& sphere = report->runs()[1];
    const Flight& quadratic = report->runs()[2];
    EXPECT_EQ(sumOf(none, &flight::TileCounts::tested), sumOf(none, &flight::TileCounts::kept));
    EXPECT_GT(sumOf(none, &flight::TileCounts::drawn), sumOf(sphere, &flight::TileCounts::drawn));
    EXPECT_GT(sumOf(sphere, &flight::TileCounts::kept), sumOf(quadratic, &flight::TileCounts::kept));
    EXPECT_GE(filesOf(none), filesOf(quadratic));
    EXPECT_GT(filesOf(quadratic), 0u);
    expectTestedByBins(quadratic);
    EXPECT_EQ(sumOf(sphere, &flight::TileCounts::binsTested), 0u);
}

TEST(ViewerFlight, AStoredDatabaseNeedsNothingButTheModules) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    const std::string plain = flights.flyOver(flights.database, "plain", "SingleThreaded", "frames=1");
    std::string error;
    const auto report = Report::of({flights.fly("none", "SingleThreaded"), plain}, {"none", "plain"}, "", error);
    ASSERT_TRUE(report.has_value()) << error << '\n' << flights.lastLog;
    expectEqualPictures(*report);
    const Flight& run = report->runs()[1];
    expectTestedByBins(run);
    EXPECT_LT(sumOf(run, &flight::TileCounts::kept), sumOf(report->runs()[0], &flight::TileCounts::kept));
}

TEST(ViewerFlight, EveryThreadingModelDrawsTheSamePictures) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    const std::vector<std::string> models{"SingleThreaded", "CullDrawThreadPerContext", "DrawThreadPerContext",
                                          "CullThreadPerCameraDrawThreadPerContext"};
    std::vector<std::string> folders{flights.fly("none", models.front())};
    std::vector<std::string> labels{"none"};
    for (const std::string& model : models) {
        folders.push_back(flights.fly("quadratic", model));
        labels.push_back(model);
    }
    std::string error;
    const auto report = Report::of(folders, labels, "", error);
    ASSERT_TRUE(report.has_value()) << error << '\n' << flights.lastLog;
    expectEqualPictures(*report);
    for (std::size_t i = 0; i < kPoses; ++i)
        for (std::size_t model = 2; model < folders.size(); ++model)
            EXPECT_EQ(report->runs()[model].poses[i].tiles.drawn, report->runs()[1].poses[i].tiles.drawn)
                << labels[model];
}

TEST(ViewerFlight, AFileThatIsMissingIsAnErrorWithoutATable) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    for (const auto& file : std::filesystem::directory_iterator(flights.folder.path()))
        if (file.path().filename().string().rfind("tiles_", 0) == 0) std::filesystem::remove(file);
    const std::string out = flights.fly("quadratic", "SingleThreaded", "frames=1,timeout=3");
    std::string error;
    EXPECT_FALSE(flight::readPoseTable(out, error).has_value());
    EXPECT_NE(flights.lastLog.find("binflight: "), std::string::npos) << flights.lastLog;
    EXPECT_NE(flights.lastLog.find("after 3 s"), std::string::npos) << flights.lastLog;
}

}  // namespace
}  // namespace osgAnalyticBin

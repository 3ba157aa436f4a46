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

TEST(ViewerFlight, EveryMethodDrawsTheSamePictures) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    const std::vector<Flight> flown =
        readFlights({flights.fly("none", "SingleThreaded"), flights.fly("sphere", "SingleThreaded"),
                     flights.fly("quadratic", "SingleThreaded")},
                    "");
    expectEqualPictures(flown);
    for (const Flight& run : flown) {
        ASSERT_EQ(run.poses.size(), kPoses);
        expectPlausible(run);
    }
    const Flight& none = flown[0];
    const Flight& sphere = flown[1];
    const Flight& quadratic = flown[2];
    EXPECT_EQ(sumOf(none.figures)["tilesTested"], sumOf(none.figures)["tilesKept"]);
    EXPECT_GT(sumOf(none.figures)["tilesDrawn"], sumOf(sphere.figures)["tilesDrawn"]);
    EXPECT_GT(sumOf(sphere.figures)["tilesKept"], sumOf(quadratic.figures)["tilesKept"]);
    EXPECT_GE(sumOf(none.figures)["files"], sumOf(quadratic.figures)["files"]);
    EXPECT_GT(sumOf(quadratic.figures)["files"], 0.0);
    expectTestedByBins(quadratic);
    EXPECT_EQ(sumOf(sphere.figures)["binsTested"], 0.0);
}

TEST(ViewerFlight, AStoredDatabaseNeedsNothingButTheModules) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    const std::string plain = flights.flyOver(flights.database, "plain", "SingleThreaded", "frames=1");
    const std::vector<Flight> flown = readFlights({flights.fly("none", "SingleThreaded"), plain}, "");
    expectEqualPictures(flown);
    const Flight& run = flown[1];
    expectTestedByBins(run);
    EXPECT_LT(sumOf(run.figures)["tilesKept"], sumOf(flown[0].figures)["tilesKept"]);
}

TEST(ViewerFlight, EveryThreadingModelDrawsTheSamePictures) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    ASSERT_FALSE(flights.database.empty());
    const std::vector<std::string> models{"SingleThreaded", "CullDrawThreadPerContext", "DrawThreadPerContext",
                                          "CullThreadPerCameraDrawThreadPerContext"};
    std::vector<std::string> folders{flights.fly("none", models.front())};
    for (const std::string& model : models) folders.push_back(flights.fly("quadratic", model));
    const std::vector<Flight> flown = readFlights(folders, "");
    expectEqualPictures(flown);
    for (std::size_t model = 2; model < folders.size(); ++model) {
        for (std::size_t pose = 0; pose < kPoses; ++pose)
            EXPECT_EQ(flown[model].figures.rows[pose]["tilesDrawn"], flown[1].figures.rows[pose]["tilesDrawn"])
                << models[model - 1];
    }
}

TEST(ViewerFlight, AFileThatIsMissingIsAnErrorWithoutATable) {
    if (!test::canRunViewer()) GTEST_SKIP() << "needs osgviewer and xvfb-run";
    const Flights flights;
    for (const auto& file : std::filesystem::directory_iterator(flights.folder.path()))
        if (file.path().filename().string().rfind("tiles_", 0) == 0) std::filesystem::remove(file);
    const std::string out = flights.fly("quadratic", "SingleThreaded", "frames=1,timeout=3");
    EXPECT_FALSE(std::filesystem::exists(out + "/poses.csv"));
    EXPECT_NE(flights.lastLog.find("binflight: "), std::string::npos) << flights.lastLog;
    EXPECT_NE(flights.lastLog.find("after 3 s"), std::string::npos) << flights.lastLog;
}

}  // namespace
}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that hold more than terrain: woods, houses, lights, billboards, things that move.

#include "BenchProgram.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <support/Random.h>
#include <support/SceneryDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::TemporaryFolder;

// Views of all heights and directions, from among the houses to above all tiles.
std::string randomPath() {
    test::Random random(1801);
    std::ostringstream path;
    path << "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n";
    for (int i = 0; i < 12; ++i) {
        const double latitude = random.uniform(0.05, 0.7), longitude = random.uniform(0.1, 1.9);
        const double altitude = random.logUniform(400.0, 60000.0);
        const double reach = random.logUniform(0.005, 0.5);
        path << 'p' << i << ',' << latitude << ',' << longitude << ',' << altitude << ','
             << latitude + reach * random.uniform(-1.0, 1.0) << ',' << longitude + reach * random.uniform(-1.0, 1.0)
             << ",150," << (random.chance(0.7) ? 60 : 20) << ',' << 0.02 * altitude << ",400000\n";
    }
    return path.str();
}

// Counts of drawables by pose and method.
using Counts = std::map<std::string, std::map<std::string, int>>;

Counts drawablesIn(const std::string& csv) {
    Counts counts;
    std::istringstream lines(csv);
    std::string head, line;
    std::getline(lines, head);
    const auto cell = [](const std::string& text, std::size_t column) {
        std::istringstream cells(text);
        std::string found;
        for (std::size_t i = 0; i <= column; ++i) std::getline(cells, found, ',');
        return found;
    };
    std::size_t column = 0;
    while (cell(head, column) != "drawables") ++column;
    while (std::getline(lines, line)) counts[cell(line, 0)][cell(line, 1)] = std::stoi(cell(line, column));
    return counts;
}

TEST(Scenery, IsDrawnAsWithoutCullingAndNoMoreOftenThanWithSpheres) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const TemporaryFolder folder;
    const std::string database = test::writeSceneryDatabase(folder.path());
    ASSERT_FALSE(database.empty());
    const std::string json = folder / "sums.json", csv = folder / "poses.csv";
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --path " + test::quoted(folder.write("p.csv", randomPath())) +
                       " --methods sphere,quadratic+horizon+edges --size 320x180 --repeats 1 --flush 0 --json " +
                       test::quoted(json) + " --csv " + test::quoted(csv));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json methods = test::jsonFile(json)["methods"];
    const nlohmann::json& bins = methods["quadratic+horizon+edges"];
    EXPECT_EQ(bins["false_culls"], 0);
    EXPECT_EQ(bins["differing_pixels"], 0);
    EXPECT_LT(bins["kept_tiles"], methods["sphere"]["kept_tiles"]);
    // without an index, files are requested as with spheres
    EXPECT_LE(bins["files_requested"], methods["sphere"]["files_requested"]);
    const Counts counts = drawablesIn(test::textOfFile(csv));
    EXPECT_EQ(counts.size(), 12u);
    for (const auto& [pose, drawables] : counts)
        EXPECT_LE(drawables.at("quadratic+horizon+edges"), drawables.at("sphere")) << pose;
}

}  // namespace
}  // namespace osgAnalyticBin

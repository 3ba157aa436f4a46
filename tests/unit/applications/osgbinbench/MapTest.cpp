// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The program on a flat map. Oracle: the pictures and the tiles of a traversal without culling.

#include "BenchProgram.h"

#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>
#include <osgAnalyticBin/index/MadeIndex.h>

#include <gtest/gtest.h>
#include <osgDB/WriteFile>

#include <PlanarMap.h>
#include <sstream>
#include <string>
#include <support/Random.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::TemporaryFolder;

// From low between the hills to high above the map, straight down and level.
std::string pathOver(const test::PlanarMap& map) {
    test::Random random(7315);
    std::ostringstream path;
    path.precision(12);
    path << "name,eyeX,eyeY,eyeAlt,lookX,lookY,lookAlt,fovDeg,near,far\n";
    for (int i = 0; i < 8; ++i) {
        const double altitude = random.logUniform(2700.0, 60000.0);
        const auto across = [&](double low) { return low + map.size * random.uniform(); };
        path << 'p' << i << ',' << across(map.origin.x()) << ',' << across(map.origin.y()) << ',' << altitude << ','
             << across(map.origin.x()) << ',' << across(map.origin.y()) << ",500," << (i % 4 == 0 ? 10 : 60) << ','
             << 0.02 * altitude << ",400000\n";
    }
    return path.str();
}

void writeIndex(const std::string& database) {
    const indexing::DatabaseFiles files(database);
    indexing::WalkObserver observer;
    const indexing::MadeIndex made = indexing::indexFrom(files, indexing::walkDatabase(files, {}, observer, 1));
    std::string error;
    ASSERT_TRUE(made.index->write(binIndexName(database), error)) << error;
}

class FlatMap : public ::testing::TestWithParam<bool> {};

TEST_P(FlatMap, IsDrawnAsWithoutCullingWithAndWithoutIndex) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    test::PlanarMap map;
    map.isTerrain = GetParam();
    const TemporaryFolder folder;
    const std::string database = folder / "map.osgb", json = folder / "sums.json";
    ASSERT_TRUE(osgDB::writeNodeFile(*map.build(folder.path()), database));
    const std::string path = folder.write("path.csv", pathOver(map));
    for (const bool hasIndex : {false, true}) {
        if (hasIndex) writeIndex(database);
        const test::Outcome outcome =
            test::runBench(test::quoted(database) + " --path " + test::quoted(path) +
                           " --methods sphere,quadratic+horizon+edges --size 320x240 --repeats 1 --flush 0 --live 0"
                           " --json " +
                           test::quoted(json));
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        const nlohmann::json methods = test::jsonFile(json)["methods"];
        const nlohmann::json &bins = methods["quadratic+horizon+edges"], &spheres = methods["sphere"];
        EXPECT_EQ(bins["false_culls"], 0) << hasIndex;
        EXPECT_EQ(bins["differing_pixels"], 0) << hasIndex;
        EXPECT_GT(bins["kept_tiles"], 8) << hasIndex;
        EXPECT_LE(bins["files_requested"], spheres["files_requested"]) << hasIndex;
        if (hasIndex) {
            EXPECT_LT(bins["kept_tiles"], spheres["kept_tiles"]);
        }
    }
}

TEST(FlatMaps, AreFlownAroundWithoutAPath) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const test::PlanarMap map;
    const TemporaryFolder folder;
    const std::string database = folder / "map.osgb", json = folder / "sums.json";
    ASSERT_TRUE(osgDB::writeNodeFile(*map.build(folder.path()), database));
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --size 160x90 --repeats 1 --flush 0 --live 0 --json " +
                       test::quoted(json) + " --report " + test::quoted(folder / "page.html"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json paths = test::jsonFile(json)["paths"];
    ASSERT_EQ(paths.size(), 4U);
    for (const auto& path : paths) {
        EXPECT_GT(path["methods"]["none"]["visible_tiles"], 0) << path;
        EXPECT_EQ(path["methods"]["bins"]["false_culls"], 0) << path;
    }
}

INSTANTIATE_TEST_SUITE_P(Makes, FlatMap, ::testing::Values(true, false),
                         [](const auto& suite) { return suite.param ? "terrain" : "polygonal"; });

}  // namespace
}  // namespace osgAnalyticBin

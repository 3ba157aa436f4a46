// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The program on a flat map. That it culls nothing in view there: tests/scenes/map.scene.

#include "BenchProgram.h"

#include <gtest/gtest.h>
#include <osgDB/WriteFile>

#include <PlanarMap.h>
#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::TemporaryFolder;

TEST(FlatMaps, AreFlownAroundWithoutAPath) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const test::PlanarMap map;
    const TemporaryFolder folder;
    const std::string database = folder / "map.osgb", json = folder / "sums.json";
    ASSERT_TRUE(osgDB::writeNodeFile(*map.build(folder.path()), database));
    const test::Outcome outcome =
        test::runBench(test::quoted(database) + " --size 160x90 --repeats 1 --flush 0 --json " + test::quoted(json) +
                       " --report " + test::quoted(folder / "page.html"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const nlohmann::json paths = test::jsonFile(json)["paths"];
    ASSERT_EQ(paths.size(), 4U);
    for (const auto& path : paths) {
        EXPECT_GT(path["methods"]["none"]["visible_tiles"], 0) << path;
        EXPECT_EQ(path["methods"]["bins"]["false_culls"], 0) << path;
    }
}

}  // namespace
}  // namespace osgAnalyticBin

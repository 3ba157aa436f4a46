// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Heights of tiles: the levels against each other, and against samples of the raster.

#include "TestGlobe.h"

#include <gdal.h>
#include <gtest/gtest.h>

#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin::paper {
namespace {

TileId tileAt(int level, double latitudeDeg, double longitudeDeg) {
    const double size = std::ldexp(22.5, -level);
    return {level, static_cast<int>((longitudeDeg + 180.0) / size), static_cast<int>((latitudeDeg + 90.0) / size)};
}

TEST(Terrain, EveryLevelHoldsTheHeightsAndTheLevelBelow) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(5);
    test::Random random(1);
    double start = 0.0, deep = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double latitudeDeg = random.uniform(-90.0, 90.0);
        const double longitudeDeg = random.uniform(-180.0, 180.0);
        const double height = terrain.height({latitudeDeg, longitudeDeg});
        for (int level = 0; level <= 5; ++level) {
            const core::Interval& range = terrain.heights(tileAt(level, latitudeDeg, longitudeDeg));
            EXPECT_GE(range.lower, 0.0) << "the sea's surface";
            EXPECT_TRUE(range.contains({height, height})) << latitudeDeg << ' ' << longitudeDeg;
            if (level == 5) continue;
            EXPECT_TRUE(range.contains(terrain.heights(tileAt(level + 1, latitudeDeg, longitudeDeg)))) << level;
        }
        start += terrain.heights(tileAt(0, latitudeDeg, longitudeDeg)).width();
        deep += terrain.heights(tileAt(5, latitudeDeg, longitudeDeg)).width();
    }
    EXPECT_GT(start / 5000.0, 2000.0) << "there were hills to hold";
    EXPECT_LT(deep, 0.5 * start);
}

TEST(Terrain, OutsideOfTheRasterItIsFlat) {
    const test::TemporaryFolder folder;
    GDALAllRegister();
    const Terrain terrain(writeHills(folder, "cut.asc", 3.0, 50.0, 60, 40, 0.1), 5);
    for (const TileId& tile : {tileAt(0, 0.0, -60.0), tileAt(5, 0.0, -60.0), tileAt(5, 56.0, 12.0)})
        EXPECT_EQ(terrain.heights(tile), (core::Interval{0.0, 0.0}));
    EXPECT_GT(terrain.heights(tileAt(5, 52.0, 6.0)).width(), 0.0);
    EXPECT_NEAR(terrain.extent().west, 3.0, 1e-9);
    EXPECT_NEAR(terrain.extent().north, 54.0, 1e-9);
}

}  // namespace
}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Heights of tiles: the levels against each other, and against samples of the raster.

#include "TestGlobe.h"

#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin::paper {
namespace {

constexpr double kDegreesPerRadian = 180.0 / 3.14159265358979323846;

template <class Function>
void forTiles(int level, const Function& function) {
    for (int y = 0; y < TileId::kStartRows << level; ++y) {
        for (int x = 0; x < TileId::kStartColumns << level; ++x) function(TileId{level, x, y});
    }
}

TileId tileAt(int level, double latitudeDeg, double longitudeDeg) {
    const double size = std::ldexp(22.5, -level);
    return {level, static_cast<int>((longitudeDeg + 180.0) / size), static_cast<int>((latitudeDeg + 90.0) / size)};
}

TEST(HeightPyramid, AParentIsTheUnionOfItsChildren) {
    const TestGlobe globe;
    const Terrain terrain = globe.terrain(4);
    for (int level = 0; level < 4; ++level) {
        forTiles(level, [&](const TileId& tile) {
            core::Interval children{HUGE_VAL, -HUGE_VAL};
            for (const TileId& child : tile.children()) {
                const core::Interval heights = terrain.pyramid().heights(child);
                children.lower = std::min(children.lower, heights.lower);
                children.upper = std::max(children.upper, heights.upper);
            }
            EXPECT_EQ(terrain.pyramid().heights(tile), children) << level << ' ' << tile.x << ' ' << tile.y;
        });
    }
}

TEST(HeightPyramid, EveryLevelHoldsTheTerrain) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(5);
    test::Random random(1);
    core::Interval seen{HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 5000; ++i) {
        const double latitudeDeg = random.uniform(-90.0, 90.0);
        const double longitudeDeg = random.uniform(-180.0, 180.0);
        const double height = terrain.height({latitudeDeg, longitudeDeg});
        seen = {std::min(seen.lower, height), std::max(seen.upper, height)};
        for (int level = 0; level <= 5; ++level) {
            const core::Interval range = terrain.pyramid().heights(tileAt(level, latitudeDeg, longitudeDeg));
            EXPECT_LE(range.lower, height) << latitudeDeg << ' ' << longitudeDeg;
            EXPECT_GE(range.upper, height) << latitudeDeg << ' ' << longitudeDeg;
        }
    }
    EXPECT_GT(seen.width(), 4000.0);  // there were hills to hold
}

TEST(HeightPyramid, DeepTilesAreFlatterThanTheirStartTile) {
    const TestGlobe globe;
    const Terrain terrain = globe.terrain(4);
    double start = 0.0;
    double deep = 0.0;
    forTiles(0, [&](const TileId& tile) { start += terrain.pyramid().heights(tile).width() / 128.0; });
    forTiles(4, [&](const TileId& tile) { deep += terrain.pyramid().heights(tile).width() / (128.0 * 256.0); });
    EXPECT_LT(deep, 0.5 * start);
}

TEST(HeightPyramid, HeightsOfTheSeaAreItsSurface) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(2);
    forTiles(2, [&](const TileId& tile) { EXPECT_GE(terrain.pyramid().heights(tile).lower, 0.0); });
    EXPECT_EQ(terrain.pyramid().heights({0, 3, 2}).lower, 0.0);
    EXPECT_GT(terrain.pyramid().heights({0, 3, 2}).upper, 0.0);
}

TEST(HeightPyramid, OutsideOfTheRasterTheTerrainIsFlat) {
    const test::TemporaryFolder folder;
    GDALAllRegister();
    Terrain terrain(writeHills(folder, "cut.asc", 3.0, 50.0, 60, 40, 0.1), 5);
    EXPECT_EQ(terrain.pyramid().heights(tileAt(0, 0.0, -60.0)), (core::Interval{0.0, 0.0}));
    EXPECT_EQ(terrain.pyramid().heights(tileAt(5, 0.0, -60.0)), (core::Interval{0.0, 0.0}));
    EXPECT_EQ(terrain.pyramid().heights(tileAt(5, 56.0, 12.0)), (core::Interval{0.0, 0.0}));
    EXPECT_GT(terrain.pyramid().heights(tileAt(5, 52.0, 6.0)).width(), 0.0);
    const osgbindem::RectDeg extent = terrain.extent();
    EXPECT_NEAR(extent.west, 3.0, 1e-9);
    EXPECT_NEAR(extent.north, 54.0, 1e-9);
}

TEST(HeightPyramid, FlatStartTilesAreAskedForOnce) {
    int asked = 0;
    const HeightPyramid pyramid(6, [&](const TileId&) {
        ++asked;
        return core::Interval{7.0, 7.0};
    });
    EXPECT_EQ(asked, 128);
    EXPECT_EQ(pyramid.heights({6, 1023, 511}), (core::Interval{7.0, 7.0}));
}

TEST(HeightPyramid, ABinIsTheTileWithItsHeights) {
    const HeightPyramid pyramid(1, [](const TileId& tile) {
        return core::Interval{-100.0 * tile.level, 100.0 + tile.x};
    });
    const core::GeodeticBin bin = pyramid.bin({1, 5, 9});
    EXPECT_NEAR(bin.latitude().lower * kDegreesPerRadian, 11.25, 1e-12);
    EXPECT_NEAR(bin.longitude().upper * kDegreesPerRadian, -112.5, 1e-12);
    EXPECT_EQ(bin.altitude(), (core::Interval{-100.0, 105.0}));
}

}  // namespace
}  // namespace osgAnalyticBin::paper

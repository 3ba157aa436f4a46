// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProceduralTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin::globe {
namespace {

using osgbindem::TileId;

constexpr double kRelief = 8000.0;

TileId randomTile(test::Random& random, int level) {
    TileId tile{level, 0, 0};
    tile.x = random.integer(0, tile.columns() - 1);
    tile.y = random.integer(0, tile.rows() - 1);
    return tile;
}

TEST(ProceduralTerrain, StaysWithinItsRelief) {
    const ProceduralTerrain terrain(kRelief);
    test::Random random(8101);
    double lowest = kRelief;
    double highest = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double height = terrain.height({random.uniform(-90.0, 90.0), random.uniform(-180.0, 180.0)});
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    EXPECT_GE(lowest, 0.0);
    EXPECT_LE(highest, kRelief);
    EXPECT_GT(highest - lowest, 0.3 * kRelief);
}

TEST(ProceduralTerrain, IsContinuousAtTheDateLineAndAtThePoles) {
    const ProceduralTerrain terrain(kRelief);
    for (const double latitude : {-89.0, -30.0, 0.0, 60.0})
        EXPECT_NEAR(terrain.height({latitude, -180.0}), terrain.height({latitude, 180.0}), 1e-6);
    for (const double pole : {-90.0, 90.0})
        EXPECT_NEAR(terrain.height({pole, 0.0}), terrain.height({pole, 123.0}), 1e-6);
}

TEST(ProceduralTerrain, BoundsHoldEveryHeightOfATile) {
    const ProceduralTerrain terrain(kRelief);
    test::Random random(8102);
    for (int level = 0; level <= 24; ++level) {
        for (int i = 0; i < 20; ++i) {
            const osgbindem::RectDeg rect = randomTile(random, level).rect();
            const core::Interval bounds = terrain.heightsIn(rect);
            core::Interval found{kRelief, 0.0};
            for (int k = 0; k < 60; ++k) {
                const double height =
                    terrain.height({random.uniform(rect.south, rect.north), random.uniform(rect.west, rect.east)});
                found = {std::min(found.lower, height), std::max(found.upper, height)};
            }
            ASSERT_TRUE(bounds.contains(found)) << level;
            ASSERT_LE(bounds.width(), kRelief + 1e-3);
            // A tile 2.4 m wide.
            if (level >= 20) {
                ASSERT_LE(bounds.width(), 3.0);
            }
        }
    }
}

TEST(ProceduralTerrain, HeightsBetweenPostsAreAsNearToTheLineAsItSays) {
    const ProceduralTerrain terrain(kRelief);
    test::Random random(8104);
    constexpr double kDegrees = 57.29577951308232;
    for (int i = 0; i < 2000; ++i) {
        const double spacing = random.logUniform(1e-8, 0.1);
        const double bound = terrain.interpolationError(spacing);
        const osgbindem::PositionDeg a{random.uniform(-80.0, 80.0), random.uniform(-180.0, 170.0)};
        osgbindem::PositionDeg b = a;
        (i % 2 ? b.latitudeDeg : b.longitudeDeg) += spacing * kDegrees;
        const double share = random.uniform(0.0, 1.0);
        const osgbindem::PositionDeg between{a.latitudeDeg + share * (b.latitudeDeg - a.latitudeDeg),
                                             a.longitudeDeg + share * (b.longitudeDeg - a.longitudeDeg)};
        const double line = (1.0 - share) * terrain.height(a) + share * terrain.height(b);
        ASSERT_LE(std::abs(terrain.height(between) - line), bound + 1e-6) << spacing;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::globe

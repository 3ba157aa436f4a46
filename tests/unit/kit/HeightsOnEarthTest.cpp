// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The altitudes that stand for terrain of which nothing is known have to hold the earth's own. Source of the heights:
// those that are published, above mean sea level.

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>

namespace osgAnalyticBin {
namespace {

constexpr double kEverest = 8848.86;            // survey of Nepal and China, 2020
constexpr double kChallengerDeep = -11034.0;    // the deepest sounding that was ever claimed, Vityaz 1957
constexpr double kHighestMeanSeaLevel = 86.0;   // above the ellipsoid, EGM2008, near New Guinea
constexpr double kLowestMeanSeaLevel = -107.0;  // the same, south of India

TEST(HeightsOnEarth, HoldTheHighestMountainAndTheDeepestSea) {
    constexpr core::Interval kHeld = CullOptions::kTerrainOnEarth;
    EXPECT_GE(kHeld.upper, kEverest + kHighestMeanSeaLevel);
    EXPECT_LE(kHeld.lower, kChallengerDeep + kLowestMeanSeaLevel);
    // and not so much more that bins and horizons lose by it
    EXPECT_LE(kHeld.upper, kEverest + 500.0);
    EXPECT_GE(kHeld.lower, kChallengerDeep - 1000.0);
    EXPECT_EQ(CullOptions().heights, kHeld);
}

}  // namespace
}  // namespace osgAnalyticBin

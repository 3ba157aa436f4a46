// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Terrain behind terrain in the experiment. Oracle: lines of sight to what is hidden, sampled (TerrainOcclusion.cpp).

#include "Experiment.h"
#include "TestGlobe.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::paper {
namespace {

TEST(TerrainOcclusion, HidesLeavesOfLowViewsAndNoneThatIsSeen) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(4);
    Progress silent(true);
    const Results results = runExperiment(terrain, {20, 1, 3.0, false, true}, silent);
    const OcclusionCounts& low = results.occlusion[0];
    EXPECT_GT(low.cameras, 0U);
    EXPECT_GT(low.hidden, low.drawn / 10) << "at least what is behind the bulge of the globe";
    EXPECT_LT(low.hidden, low.drawn);
    for (const OcclusionCounts& counts : results.occlusion) EXPECT_EQ(counts.seenHidden, 0U);
    EXPECT_EQ(results.occlusion[4].cameras, 0U) << "views straight down are left out";
}

TEST(TerrainOcclusion, IsNotCountedUnlessAskedFor) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(2);
    Progress silent(true);
    const Results results = runExperiment(terrain, {1, 1, 3.0, false}, silent);
    for (const OcclusionCounts& counts : results.occlusion) EXPECT_EQ(counts.cameras, 0U);
}

}  // namespace
}  // namespace osgAnalyticBin::paper

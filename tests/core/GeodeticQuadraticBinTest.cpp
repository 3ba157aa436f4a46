// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: the closed form in long double. The two bins themselves: QuadraticBinTest, ExactGeodeticBinTest.

#include <osgAnalyticBin/core/bin/GeodeticQuadraticBin.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticBin;
using core::GeodeticQuadraticBin;
using core::Interval;
using core::Plane;
using core::Side;

TEST(GeodeticQuadraticBin, WideTilesAreExactAndSmallOnesAreNot) {
    Random random(130);
    for (int trial = 0; trial < 2000; ++trial) {
        for (int level = 0; level <= kDeepestLevel; ++level) {
            const GeodeticBin bin = randomTile(random, level, kTerrainAltitudes);
            ASSERT_EQ(GeodeticQuadraticBin(wgs84(), bin).isExact(), level < 2) << level;
        }
    }
    EXPECT_TRUE(GeodeticQuadraticBin(wgs84(), GeodeticBin::wholeGlobe(kTerrainAltitudes)).isExact());
}

TEST(GeodeticQuadraticBin, BelowTheCentresOfCurvatureOnlyTheModelHolds) {
    EXPECT_FALSE(GeodeticQuadraticBin(wgs84(), GeodeticBin::wholeGlobe({-6.37e6, 0.0})).isExact());
}

TEST(GeodeticQuadraticBin, RangeExceedsTheTruthByTheStatedPartOfTheExtent) {
    Random random(131);
    double largest = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const BinOracle oracle(randomEllipsoid(random), randomBin(random));
        const Plane plane{random.direction(), 0.0};
        const Interval range = GeodeticQuadraticBin(oracle.ellipsoid(), oracle.bin()).distanceRange(plane);
        const RealRange truth = oracle.distanceRange(plane);
        ASSERT_LE(range.lower, truth.lower + oracle.rounding(plane));
        ASSERT_GE(range.upper, truth.upper - oracle.rounding(plane));
        const double extent = sizeOf(oracle.ellipsoid(), oracle.bin()) * 1.1;
        const auto excess = static_cast<double>(std::max(truth.lower - range.lower, range.upper - truth.upper));
        ASSERT_LE(excess, 2.0 * core::kLargestRelativeRemainder * extent + 1e-6);
        if (extent > 1.0) largest = std::max(largest, (excess - 1e-6) / extent);
    }
    std::printf("largest excess: %.3f %% of the extent (promised %.3f %%)\n", 100.0 * largest,
                200.0 * core::kLargestRelativeRemainder);
}

TEST(GeodeticQuadraticBin, ClassifiesAsItsBinDoes) {
    Random random(132);
    for (int trial = 0; trial < 20000; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, 4), kTerrainAltitudes));
        const GeodeticQuadraticBin bin = GeodeticQuadraticBin(oracle.ellipsoid(), oracle.bin());
        core::PlaneSet planes;
        for (int i = 0; i < 4; ++i) planes.push_back(randomPlane(random, oracle, random.pick(kPlaneKinds)));
        core::PlaneMask undecided = planes.all();
        core::PlaneMask expectedUndecided = planes.all();
        const Side expected = core::classify<GeodeticQuadraticBin>(bin, planes, planes.size(), expectedUndecided);
        ASSERT_EQ(core::classify(bin, planes, undecided), expected);
        if (expected != Side::Outside) {
            ASSERT_EQ(undecided, expectedUndecided);
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: the closed form in long double. The two bins themselves: QuadraticBinTest, ExactGeodeticBinTest.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::quadraticOrExact;

bool isExact(const core::QuadraticOrExact& bin) {
    return std::holds_alternative<core::ExactGeodeticBin>(bin);
}

TEST(QuadraticOrExact, WideTilesAreExactAndSmallOnesAreNot) {
    Random random(130);
    for (int trial = 0; trial < 2000; ++trial) {
        for (int level = 0; level <= kDeepestLevel; ++level) {
            const GeodeticBin bin = randomTile(random, level, kTerrainAltitudes);
            ASSERT_EQ(isExact(quadraticOrExact(wgs84(), bin)), level < 2) << level;
        }
    }
    EXPECT_TRUE(isExact(quadraticOrExact(wgs84(), GeodeticBin::wholeGlobe(kTerrainAltitudes))));
}

TEST(QuadraticOrExact, BelowTheCentresOfCurvatureOnlyTheModelHolds) {
    EXPECT_FALSE(isExact(quadraticOrExact(wgs84(), GeodeticBin::wholeGlobe({-6.37e6, 0.0}))));
}

TEST(QuadraticOrExact, RangeExceedsTheTruthByTheStatedPartOfTheExtent) {
    Random random(131);
    double largest = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const BinOracle oracle(randomEllipsoid(random), randomBin(random));
        const Plane plane{random.direction(), 0.0};
        const Interval range = std::visit([&](const auto& form) { return form.distanceRange(plane); },
                                          quadraticOrExact(oracle.ellipsoid(), oracle.bin()));
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

}  // namespace
}  // namespace osgAnalyticBin::test

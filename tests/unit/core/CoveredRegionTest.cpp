// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: latitudes and longitudes of points along segments to all corners of the region.

#include "RandomRegions.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <support/Random.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::CoveredRegion;
using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;

TEST(CoveredRegion, HoldsAllSegments) {
    Random random(1702);
    int held = 0, over = 0;
    for (int trial = 0; trial < 8000; ++trial) {
        const Ellipsoid ellipsoid = randomGlobe(random);
        const double most = 0.1 * ellipsoid.polarRadius();
        const GeodeticBin region = randomRegion(random);
        const auto [south, north] = region.latitude();
        const auto [west, east] = region.longitude();
        // near the northern border half of the time, and far from it compared with the bulge of parallels
        const double fromNorth =
            random.chance(0.5) ? (north - south) * random.logUniform(1e-6, 1.0) : (north - south) * random.uniform();
        const auto altitude = [&] { return random.sign() * most * random.logUniform(1e-7, 0.99); };
        const Geodetic place{std::max(south, north - fromNorth), random.uniform(west, east), altitude()};
        const glm::dvec3 eye = ellipsoid.toEcef(place);
        bool isTrue = true;
        for (int target = 0; target < 24 && isTrue; ++target) {
            const double share = random.chance(0.5) ? 0.0 : random.logUniform(1e-8, 1.0);
            const bool isNorthern = random.chance(0.5);
            const double at = isNorthern ? north - share * (north - south) : south + share * (north - south);
            const std::array<double, 3> longitudes{west, east, random.uniform(west, east)};
            isTrue = isSegmentOver(region, ellipsoid, eye, ellipsoid.toEcef({at, random.pick(longitudes), altitude()}));
        }
        const bool isHeld = CoveredRegion(ellipsoid, region).holdsSegmentsFrom(eye);
        ASSERT_TRUE(isTrue || !isHeld) << "trial " << trial;
        const bool isWide = region.longitude().width() > 0.49 * kPi;
        over += isTrue && !isWide;
        held += isHeld && !isWide;
    }
    EXPECT_GT(over, 1200) << "nothing is tested";
    EXPECT_GT(held, 0.85 * over);
}

TEST(CoveredRegion, InAMapHoldsWhatAnEyeOverItSees) {
    constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
    const GeodeticBin region({1000.0 / kUnits, 3000.0 / kUnits}, {-500.0 / kUnits, 500.0 / kUnits}, {0.0, 0.0});
    const CoveredRegion covered(Ellipsoid::plane(), region);
    EXPECT_TRUE(covered.holdsSegmentsFrom({0.0, 2000.0, 1e6}));
    EXPECT_TRUE(covered.holdsSegmentsFrom({499.0, 1001.0, -1e3}));
    EXPECT_FALSE(covered.holdsSegmentsFrom({501.0, 2000.0, 100.0}));
    EXPECT_FALSE(covered.holdsSegmentsFrom({0.0, 999.0, 100.0}));
    EXPECT_FALSE(covered.holdsSegmentsFrom({0.0, 3001.0, 100.0}));
}

TEST(CoveredRegion, ContainsWhatIsOverIt) {
    const CoveredRegion region(wgs84(), {{0.1, 0.4}, {3.0, 3.4}, {0.0, 0.0}});
    EXPECT_TRUE(region.contains({{0.1, 0.2}, {-3.2, -3.0}, {-100.0, 9000.0}}));
    EXPECT_FALSE(region.contains({{0.1, 0.41}, {3.1, 3.2}, {0.0, 0.0}}));
    EXPECT_FALSE(region.contains({{0.2, 0.3}, {2.9, 3.2}, {0.0, 0.0}}));
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: latitudes and longitudes of points along segments to all corners of the region, and along lines of sight to
// where they meet the occluder.

#include "CoreTest.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

namespace osgAnalyticBin::test {
namespace {

using core::CoveredRegion;

// Radians by which a position may be beside a region and count as over it: rounding of the conversion.
constexpr double kOverRegion = 1e-10;

Ellipsoid randomGlobe(Random& random) {
    if (random.chance(0.5)) return wgs84();
    const double a = random.logUniform(1e5, 1e8);
    return {a, a * std::sqrt(1.0 - random.uniform(-0.01, 0.01))};
}

// Some touch a pole, go round the globe, or end at the equator.
GeodeticBin randomRegion(Random& random) {
    const double height = random.logUniform(1e-4, kPi), width = random.logUniform(1e-4, 2.0 * kPi);
    double south = random.uniform(-kHalfPi, kHalfPi);
    if (random.chance(0.1)) south = 0.0;
    if (random.chance(0.1)) south = -height;
    if (random.chance(0.1)) south = kHalfPi - height;
    const double west = random.uniform(-kPi, kPi);
    const bool isFullCircle = random.chance(0.15);
    return {{south, south + height}, {west, west + (isFullCircle ? 2.0 * kPi : width)}, {0.0, 0.0}};
}

bool isOver(const GeodeticBin& region, const Ellipsoid& ellipsoid, const glm::dvec3& point) {
    const Geodetic at = ellipsoid.toGeodetic(point);
    const core::Interval& latitude = region.latitude();
    if (at.latitude < latitude.lower - kOverRegion || at.latitude > latitude.upper + kOverRegion) return false;
    // longitudes mean little near the axis
    const double slack = kOverRegion / std::max(1e-6, std::cos(at.latitude));
    const double aside = std::remainder(at.longitude - region.longitude().middle(), 2.0 * kPi);
    return std::abs(aside) <= 0.5 * region.longitude().width() + slack;
}

bool isSegmentOver(const GeodeticBin& region, const Ellipsoid& ellipsoid, const glm::dvec3& from,
                   const glm::dvec3& to) {
    constexpr int kSteps = 48;
    for (int step = 0; step <= kSteps; ++step)
        if (!isOver(region, ellipsoid, glm::mix(from, to, static_cast<double>(step) / kSteps))) return false;
    return true;
}

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

// By points where lines of sight meet the occluder, half of them on the horizon.
bool seesOccluderOverRegion(const GeodeticBin& region, const Ellipsoid& ellipsoid, const HorizonEye& eye,
                            const glm::dvec3& eyeEcef, Random& random) {
    const auto& data = eye.data();
    const glm::dvec3 toEye(data.x, data.y, data.z);
    const glm::dvec3 aside = glm::normalize(glm::cross(toEye, random.direction()));
    const glm::dvec3 ahead = glm::cross(toEye, aside);
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    constexpr int kDirections = 64;
    const double dip = std::atan2(data.sinDip, data.cosDip);
    for (int i = 0; i < 2 * kDirections; ++i) {
        const double angle = 2.0 * kPi * i / kDirections;
        const double down = i < kDirections ? dip : dip * random.uniform();
        const glm::dvec3 direction =
            std::cos(down) * toEye + std::sin(down) * (std::cos(angle) * ahead + std::sin(angle) * aside);
        if (!isSegmentOver(region, ellipsoid, eyeEcef, data.scale * radii * direction)) return false;
    }
    return true;
}

TEST(CoveredRegion, HoldsTheHorizonWhereAllOfItIsOverTheRegion) {
    Random random(1701);
    int held = 0, over = 0;
    for (int trial = 0; trial < 8000; ++trial) {
        const Ellipsoid ellipsoid = randomGlobe(random);
        const double radius = ellipsoid.polarRadius();
        const GeodeticBin region = randomRegion(random);
        const auto [south, north] = region.latitude();
        const auto [west, east] = region.longitude();
        const double dip = 0.5 * std::max(north - south, east - west) * random.logUniform(0.02, 1.5);
        const double height = std::min(0.5 * radius * dip * dip, 10.0 * radius) * random.uniform(0.3, 1.0);
        const double depth = random.chance(0.3) ? 0.0 : height * random.logUniform(1e-3, 1.0);
        const glm::dvec3 eyeEcef = ellipsoid.toEcef({random.uniform(south, north), random.uniform(west, east), height});
        const auto eye = HorizonEye::fromEye(ellipsoid, depth, eyeEcef);
        if (!eye) continue;
        const bool isTrue = seesOccluderOverRegion(region, ellipsoid, *eye, eyeEcef, random);
        const bool isHeld = CoveredRegion(ellipsoid, region).holdsHorizonOf(*eye);
        EXPECT_TRUE(isTrue || !isHeld) << "trial " << trial;
        over += isTrue;
        held += isHeld;
    }
    EXPECT_GT(over, 1000) << "nothing is tested";
    EXPECT_GT(held, 0.93 * over);
}

TEST(CoveredRegion, HoldsTheHorizonOfAGlobeButOfNoOrthographicCamera) {
    const auto eye = HorizonEye::fromEye(wgs84(), 100.0, wgs84().toEcef({0.3, 3.1, 1e7}));
    const auto direction = HorizonEye::fromDirection(wgs84(), 0.0, {-1.0, 0.0, 0.0}, {1e7, 0.0, 0.0});
    ASSERT_TRUE(eye && direction);
    const CoveredRegion globe(wgs84(), GeodeticBin::wholeGlobe({0.0, 0.0}));
    EXPECT_TRUE(globe.holdsHorizonOf(*eye));
    EXPECT_FALSE(globe.holdsHorizonOf(*direction));
    EXPECT_FALSE(CoveredRegion(wgs84(), GeodeticBin()).holdsHorizonOf(*eye));
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

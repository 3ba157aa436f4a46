// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: latitudes and longitudes of points along lines of sight, to the tangent points of the occluder, and to points
// of bins as far as they come before the occluder stops them.

#include "RandomRegions.h"

#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/horizon/RegionalSight.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <support/Random.h>
#include <support/RandomBins.h>
#include <support/View.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::CoveredRegion;
using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;
using core::HorizonBin;
using core::HorizonEye;
using core::Interval;
using core::RegionalSight;

double reachOf(const GeodeticBin& region) {
    return 0.5 * std::max(region.latitude().width(), region.longitude().width());
}

core::PlaneSet asSet(const std::vector<core::Plane>& planes) {
    core::PlaneSet set;
    for (const core::Plane& plane : planes) set.push_back(plane);
    return set;
}

// By points where lines of sight meet the occluder, most of them on the horizon.
bool seesOccluderOverRegion(const GeodeticBin& region, const Ellipsoid& ellipsoid, const HorizonEye& eye,
                            const glm::dvec3& eyeEcef, const std::vector<core::Plane>& frustum, Random& random,
                            bool& isAnySeen) {
    const auto& data = eye.data();
    const glm::dvec3 toEye(data.x, data.y, data.z);
    const glm::dvec3 aside = glm::normalize(glm::cross(toEye, random.direction()));
    const glm::dvec3 ahead = glm::cross(toEye, aside);
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    constexpr int kDirections = 64;
    const double dip = std::atan2(data.sinDip, data.cosDip);
    isAnySeen = false;
    for (int i = 0; i < 2 * kDirections; ++i) {
        const double angle = 2.0 * kPi * i / kDirections;
        const double down = i < kDirections ? dip : dip * random.uniform();
        const glm::dvec3 direction =
            std::cos(down) * toEye + std::sin(down) * (std::cos(angle) * ahead + std::sin(angle) * aside);
        const glm::dvec3 point = data.scale * radii * direction;
        const bool isInPicture = std::all_of(frustum.begin(), frustum.end(),
                                             [&](const core::Plane& plane) { return plane.distance(point) >= 0.0; });
        isAnySeen = isAnySeen || isInPicture;
        if (isInPicture && !isSegmentOver(region, ellipsoid, eyeEcef, point)) return false;
    }
    return true;
}

bool holdsAll(const HorizonEye& eye, const CoveredRegion& region, const core::PlaneSet& frustum) {
    const auto sight = RegionalSight::from(eye, region, frustum);
    return sight && sight->holdsAll();
}

struct Share {
    int held = 0, over = 0;
};

// Views of the occluder from over a region, about as far as its border. `hasFrustum`: they have a picture.
Share shareOfHeldHorizons(Random& random, bool hasFrustum) {
    Share share;
    for (int trial = 0; trial < 8000; ++trial) {
        const Ellipsoid ellipsoid = randomGlobe(random);
        const double radius = ellipsoid.polarRadius();
        const GeodeticBin region = randomRegion(random);
        const Interval& latitude = region.latitude();
        const double dip = reachOf(region) * random.logUniform(0.02, 1.5);
        const double height = std::min(0.5 * radius * dip * dip, 10.0 * radius) * random.uniform(0.3, 1.0);
        const Geodetic place{random.uniform(latitude.lower, latitude.upper),
                             random.uniform(region.longitude().lower, region.longitude().upper), height};
        const double depth = random.chance(0.3) ? 0.0 : height * random.logUniform(1e-3, 1.0);
        const glm::dvec3 eyeEcef = ellipsoid.toEcef(place);
        const auto eye = HorizonEye::fromEye(ellipsoid, depth, eyeEcef);
        if (!eye) continue;
        View view;
        view.eye = eyeEcef;
        view.halfWidth = random.logUniform(0.01, 3.0);
        if (random.chance(0.5)) view.nearDistance = height * random.logUniform(1e-3, 0.9);
        if (random.chance(0.5)) view.farDistance = height * random.logUniform(2.0, 1e6);
        const Geodetic ahead{random.uniform(latitude.lower, latitude.upper),
                             random.uniform(region.longitude().lower, region.longitude().upper), 0.0};
        view.lookAlong(ellipsoid.toEcef(ahead) - eyeEcef, random);
        const std::vector<core::Plane> frustum = hasFrustum ? view.planes() : std::vector<core::Plane>();
        // lines of sight begin at the eye
        View fromEye = view;
        fromEye.nearDistance = -HUGE_VAL;
        bool isAnySeen = false;
        const bool isTrue = seesOccluderOverRegion(region, ellipsoid, *eye, eyeEcef,
                                                   hasFrustum ? fromEye.planes() : frustum, random, isAnySeen);
        const bool isHeld = holdsAll(*eye, CoveredRegion(ellipsoid, region), asSet(frustum));
        EXPECT_TRUE(isTrue || !isHeld) << "trial " << trial;
        share.over += isTrue && isAnySeen;
        share.held += isHeld && isAnySeen;
    }
    return share;
}

TEST(RegionalSight, HoldsAllLinesOfSightToTheOccluder) {
    Random random(1701);
    const Share around = shareOfHeldHorizons(random, false);
    EXPECT_GT(around.over, 1000) << "nothing is tested";
    EXPECT_GT(around.held, 0.93 * around.over);
    const Share inView = shareOfHeldHorizons(random, true);
    EXPECT_GT(inView.over, 1000) << "nothing is tested";
    EXPECT_GT(inView.held, 0.8 * inView.over);
}

// An eye over a region, and its view.
struct Outlook {
    explicit Outlook(Random& random) : ellipsoid(randomGlobe(random)), region(randomRegion(random)) {
        const Interval& latitude = region.latitude();
        const Interval& longitude = region.longitude();
        reach = reachOf(region);
        const double dip = reach * random.logUniform(0.02, 0.7);
        const double radius = ellipsoid.polarRadius();
        const double height = std::min(0.5 * radius * dip * dip, 3.0 * radius);
        // at the northern or eastern border half of the time
        const double aside = random.chance(0.5) ? random.logUniform(1e-4, 0.5) : random.uniform();
        const double north = random.chance(0.5) ? random.logUniform(1e-4, 0.5) : random.uniform();
        eye = ellipsoid.toEcef(
            {latitude.upper - north * latitude.width(), longitude.upper - aside * longitude.width(), height});
        depth = random.chance(0.5) ? 0.0 : height * random.logUniform(1e-3, 0.5);
        horizon = HorizonEye::fromEye(ellipsoid, depth, eye);
    }

    // Of any size, in the region or across its border.
    [[nodiscard]] GeodeticBin randomTile(Random& random) const {
        const auto within = [&](const Interval& all) {
            const double width = 2.0 * reach * random.logUniform(1e-4, 0.3);
            const double place = random.chance(0.3) ? random.uniform(-0.1, 0.0) : random.uniform();
            const double lower = all.lower + (random.chance(0.5) ? place : 1.0 - place) * all.width() - 0.5 * width;
            return Interval{lower, lower + width};
        };
        const Interval latitude = within(region.latitude());
        return {{std::clamp(latitude.lower, -kHalfPi, kHalfPi), std::clamp(latitude.upper, -kHalfPi, kHalfPi)},
                within(region.longitude()),
                {0.0, glm::length(eye) * 1e-3 * reach * reach}};
    }

    // Where the line of sight to a point meets the occluder.
    [[nodiscard]] std::optional<glm::dvec3> entryOf(const glm::dvec3& point) const {
        const glm::dvec3 scale =
            horizon->data().scale *
            glm::dvec3(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
        const glm::dvec3 from = eye / scale, along = (point - eye) / scale;
        const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from) - 1.0;
        const double root = b * b - a * c;
        if (!(root > 0.0)) return std::nullopt;
        const double share = (-b - std::sqrt(root)) / a;
        if (!(share >= 0.0 && share <= 1.0)) return std::nullopt;
        return eye + share * (point - eye);
    }

    // By random points of the tile in the picture, up to a margin beside it.
    [[nodiscard]] bool staysOverTheRegion(const GeodeticBin& tile, double margin,
                                          const std::vector<core::Plane>& frustum, Random& random) const {
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 point = ellipsoid.toEcef(randomPosition(random, tile)) + margin * random.direction();
            const bool isInPicture = std::all_of(frustum.begin(), frustum.end(),
                                                 [&](const core::Plane& plane) { return plane.distance(point) >= 0; });
            const auto entry = isInPicture ? entryOf(point) : std::nullopt;
            if (entry && !isSegmentOver(region, ellipsoid, eye, *entry)) return false;
        }
        return true;
    }

    Ellipsoid ellipsoid;
    GeodeticBin region;
    double reach = 0.0, depth = 0.0;
    glm::dvec3 eye{0.0};
    std::optional<HorizonEye> horizon;
};

TEST(RegionalSight, HoldsNoBinThatIsSeenPastABorder) {
    Random random(1703);
    int held = 0, over = 0, passed = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Outlook outlook(random);
        if (!outlook.horizon) continue;
        const bool hasFrustum = random.chance(0.3);
        View view;
        view.eye = outlook.eye;
        view.halfWidth = random.logUniform(0.05, 2.0);
        const GeodeticBin target = outlook.randomTile(random);
        view.lookAlong(outlook.ellipsoid.toEcef(target.center()) - outlook.eye, random);
        const std::vector<core::Plane> frustum = hasFrustum ? view.planes() : std::vector<core::Plane>();
        const auto sight =
            RegionalSight::from(*outlook.horizon, CoveredRegion(outlook.ellipsoid, outlook.region), asSet(frustum));
        for (int i = 0; i < 8; ++i) {
            const GeodeticBin tile = i == 0 ? target : outlook.randomTile(random);
            const double margin = random.chance(0.5) ? 0.0 : 0.1 * outlook.reach * random.uniform() * outlook.depth;
            const HorizonBin bin(outlook.ellipsoid, tile, margin);
            if (!outlook.horizon->hides(bin)) continue;
            const bool isTrue = outlook.staysOverTheRegion(tile, margin, frustum, random);
            const bool isHeld = sight && sight->holds(bin);
            ASSERT_TRUE(isTrue || !isHeld) << "trial " << trial << ", tile " << i;
            over += isTrue;
            held += isHeld;
            passed += !isTrue;
        }
    }
    EXPECT_GT(passed, 400) << "nothing is tested";
    EXPECT_GT(over, 3000) << "nothing is tested";
    EXPECT_GT(held, 0.78 * over);
}

TEST(RegionalSight, HoldsTheSameOfAFamily) {
    Random random(1704);
    int held = 0, past = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Outlook outlook(random);
        if (!outlook.horizon) continue;
        const auto sight = RegionalSight::from(*outlook.horizon, CoveredRegion(outlook.ellipsoid, outlook.region), {});
        if (!sight) continue;
        core::BinFamily family(7);
        std::vector<HorizonBin> bins;
        for (std::size_t i = 0; i < 7; ++i) {
            const GeodeticBin tile = outlook.randomTile(random);
            family.set(i, core::ExactGeodeticBin(outlook.ellipsoid, tile));
            bins.emplace_back(outlook.ellipsoid, tile);
            family.setHorizon(i, bins.back());
        }
        family.clear(3);
        const std::uint64_t result = family.heldIn(*sight, 0b1111101);
        for (std::size_t i = 0; i < 7; ++i) {
            const bool isHeld = i != 1 && i != 3 && sight->holds(bins[i]);
            ASSERT_EQ((result >> i & 1) != 0, isHeld) << "trial " << trial << ", slot " << i;
            held += isHeld;
            past += i != 1 && i != 3 && !isHeld;
        }
    }
    EXPECT_GT(held, 100);
    EXPECT_GT(past, 100);
}

TEST(RegionalSight, IsAGlobeToo) {
    const auto eye = HorizonEye::fromEye(wgs84(), 100.0, wgs84().toEcef({0.3, 3.1, 1e7}));
    ASSERT_TRUE(eye);
    EXPECT_TRUE(holdsAll(*eye, {wgs84(), GeodeticBin::wholeGlobe({0.0, 0.0})}, {}));
    EXPECT_FALSE(holdsAll(*eye, {wgs84(), GeodeticBin()}, {}));
}

TEST(RegionalSight, HoldsNothingForAnOrthographicCamera) {
    const auto eye = HorizonEye::fromDirection(wgs84(), 0.0, {-1.0, 0.0, 0.0}, {1e7, 0.0, 0.0});
    ASSERT_TRUE(eye);
    EXPECT_FALSE(RegionalSight::from(*eye, {wgs84(), GeodeticBin::wholeGlobe({0.0, 0.0})}, {}));
}

}  // namespace
}  // namespace osgAnalyticBin::test

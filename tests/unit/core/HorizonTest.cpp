// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the exact intersection of a line of sight with the occluder in long double, at sampled points of the bin and
// at points made so that the line of sight just misses; relations. Soundness.cpp makes ten million more trials. Of
// regions: latitudes and longitudes of points along segments to all corners, and along lines of sight to where they
// meet the occluder.

#include "CoreTest.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

namespace osgAnalyticBin::test {
namespace {

// Lowest terrain on earth.
constexpr double kDepth = 11000.0;

glm::dvec3 onWgs84(double latitudeDeg, double longitudeDeg, double altitude) {
    return wgs84().toEcef({latitudeDeg * kRadiansPerDegree, longitudeDeg * kRadiansPerDegree, altitude});
}

bool hides(const glm::dvec3& eye, const GeodeticBin& bin, double depth = kDepth, double margin = 0.0) {
    const auto prepared = HorizonEye::fromEye(wgs84(), depth, eye);
    return prepared && prepared->hides(HorizonBin(wgs84(), bin, margin));
}

GeodeticBin square(double southDeg, double westDeg, double sizeDeg, Interval altitude = {0.0, 1000.0}) {
    return GeodeticBin::fromDegrees({southDeg, southDeg + sizeDeg}, {westDeg, westDeg + sizeDeg}, altitude);
}

// The share of the way from the eye to a point at which a line of sight enters the occluder.
double trueShare(const Ellipsoid& ellipsoid, const HorizonEye& eye, const glm::dvec3& from, const glm::dvec3& to) {
    const double a = ellipsoid.equatorialRadius(), b = ellipsoid.polarRadius(), scale = eye.data().scale;
    const glm::dvec3 radii(a * scale, a * scale, b * scale);
    const glm::dvec3 start = from / radii, way = to / radii - start;
    const double across = glm::dot(start, way) / glm::dot(way, way);
    return -across - std::sqrt(across * across - (glm::dot(start, start) - 1.0) / glm::dot(way, way));
}

TEST(Horizon, SharesOfBallsAreUpperBounds) {
    Random random(310);
    int hidden = 0, tight = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const double depth = randomDepth(random);
        const glm::dvec3 eye = randomEye(random, ellipsoid, depth);
        const auto prepared = HorizonEye::fromEye(ellipsoid, depth, eye);
        if (!prepared) continue;
        const glm::dvec3 centre = rounded(geodeticToEcef(ellipsoid, randomPosition(random, randomBin(random))));
        const double radius = random.logUniform(1.0, 1e5);
        const double share = prepared->shareBefore(ellipsoid, centre, radius);
        if (!(share < 1.0)) continue;
        ++hidden;
        double largest = 0.0;
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 point = centre + radius * random.direction();
            ASSERT_FALSE(segmentMissesOccluder(ellipsoid, depth, real(point), real(eye))) << "trial " << trial;
            largest = std::max(largest, trueShare(ellipsoid, *prepared, eye, point));
        }
        ASSERT_LE(largest, share * (1.0 + 1e-9)) << "trial " << trial;
        tight += largest > 0.2 * share;
    }
    EXPECT_GT(hidden, 10000);
    EXPECT_GT(5 * tight, hidden);
}

// On a sphere, where balls stay balls: the point at which a ball touches a line of sight that touches the occluder.
TEST(Horizon, SharesOfBallsHoldForLinesOfSightThatTouchTheOccluder) {
    constexpr double kRadius = 6.4e6;
    const Ellipsoid sphere(kRadius, kRadius);
    Random random(312);
    int hidden = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 up = random.direction(), aside = glm::normalize(glm::cross(up, random.direction()));
        const double distance = kRadius * (1.0 + random.logUniform(1e-4, 10.0));
        const double dip = std::acos(kRadius / distance), toHorizon = kRadius * std::tan(dip);
        const glm::dvec3 eye = distance * up, outward = std::cos(dip) * up + std::sin(dip) * aside;
        const glm::dvec3 along = std::sin(dip) * -up + std::cos(dip) * aside;
        const double radius = toHorizon * random.logUniform(1e-3, 0.5);
        const double toBall = toHorizon + random.uniform(1.0, 10.0) * radius;
        const glm::dvec3 touched = eye + toBall * along, centre = touched - (radius + 1e-3) * outward;
        const auto prepared = HorizonEye::fromEye(sphere, 0.0, eye);
        ASSERT_TRUE(prepared);
        const double share = prepared->shareBefore(sphere, centre, radius);
        if (!(share < 1.0)) continue;
        ++hidden;
        ASSERT_GE(share * (1.0 + 1e-9), toHorizon / toBall) << "trial " << trial;
    }
    EXPECT_GT(hidden, 500);
}

// The end of a bin that is next to the horizon is at its highest or at its lowest altitude.
TEST(Horizon, SeesBinsOfWhichACornerIsJustInSight) {
    constexpr double kBeyond = 1e-6;  // radians, less than the corners at both altitudes are apart
    constexpr double kHigh = 9000.0;
    const double a = wgs84().equatorialRadius(), b = wgs84().polarRadius();
    for (const double latitudeDeg : {-40.0, -20.0, 20.0, 40.0}) {
        const double side = latitudeDeg < 0.0 ? -1.0 : 1.0;  // of the equator: the eye is nearer to the pole
        const GeodeticBin bin = square(latitudeDeg - (side > 0.0 ? 1.0 : 0.0), -0.5, 1.0, {0.0, kHigh});
        const glm::dvec3 corner = onWgs84(latitudeDeg, 0.0, kHigh) / glm::dvec3(a, a, b);
        for (const double distance : {1.001, 1.05, 1.2}) {
            const double toHorizon = std::acos(1.0 / distance) + std::acos(1.0 / glm::length(corner));
            const auto hidesFrom = [&](double angle) {
                const double latitude = std::atan2(corner.z, corner.x) + side * angle;
                const glm::dvec3 direction(std::cos(latitude) * a, 0.0, std::sin(latitude) * b);
                return hides(distance * direction, bin, 0.0);
            };
            EXPECT_FALSE(hidesFrom(toHorizon - kBeyond)) << latitudeDeg << " from " << distance;
            EXPECT_TRUE(hidesFrom(toHorizon + kBeyond)) << latitudeDeg << " from " << distance;
        }
    }
}

TEST(Horizon, SeesBinsAndBallsOfWhichALineOfSightJustMisses) {
    Random random(311);
    int seen = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const LineOfSight line = randomLineOfSight(random);
        if (!segmentMissesOccluder(line.ellipsoid, line.depth, line.target, real(line.eye))) continue;
        const auto prepared = HorizonEye::fromEye(line.ellipsoid, line.depth, line.eye);
        if (!prepared) continue;
        ++seen;
        ASSERT_FALSE(prepared->hides(HorizonBin(line.ellipsoid, line.bin, line.margin))) << "trial " << trial;
        const double radius = random.logUniform(1e-3, 1e5);
        const glm::dvec3 centre = rounded(line.target) + random.uniform(0.0, radius) * random.direction();
        ASSERT_FALSE(prepared->shareBefore(line.ellipsoid, centre, radius + 1e-6) < 1.0) << "trial " << trial;
    }
    EXPECT_GT(seen, 50000);
}

// The share of truly hidden tiles that are found; truth by dense sampling, which calls too many hidden, if anything.
template <class IsVisible>
double percentFound(Random& random, int level, const IsVisible& isVisible, const HorizonEye& eye) {
    constexpr int kSteps = 16;
    int hidden = 0, found = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const GeodeticBin bin = randomTile(random, level, {-500.0, 3000.0});
        bool visible = false;
        for (int i = 0; i <= kSteps && !visible; ++i) {
            for (int j = 0; j <= kSteps && !visible; ++j) {
                const Geodetic position{bin.latitude().lower + bin.latitude().width() * i / kSteps,
                                        bin.longitude().lower + bin.longitude().width() * j / kSteps,
                                        bin.altitude().upper};
                visible = isVisible(geodeticToEcef(wgs84(), position));
            }
        }
        const bool isFound = eye.hides(HorizonBin(wgs84(), bin));
        EXPECT_FALSE(visible && isFound) << trial;
        hidden += visible ? 0 : 1;
        found += isFound ? 1 : 0;
    }
    return 100.0 * found / hidden;
}

TEST(Horizon, FindsNearlyAllHiddenTiles) {
    constexpr double kBar = 99.5;
    Random random(303);
    for (const int level : {0, 1, 2, 3, 4}) {
        for (const double altitude : {100.0, 1e4, 1e6, 1e9}) {
            const glm::dvec3 eye = onWgs84(random.uniform(-90.0, 90.0), random.uniform(-180.0, 180.0), altitude);
            const auto prepared = HorizonEye::fromEye(wgs84(), kDepth, eye);
            ASSERT_TRUE(prepared);
            const auto isVisible = [&](const RealVector& p) {
                return segmentMissesOccluder(wgs84(), kDepth, p, real(eye));
            };
            EXPECT_GE(percentFound(random, level, isVisible, *prepared), kBar) << level << " at " << altitude;
        }
    }
    // of an orthographic camera
    for (int trial = 0; trial < 8; ++trial) {
        const glm::dvec3 direction = random.direction();
        const auto prepared = HorizonEye::fromDirection(wgs84(), kDepth, direction, -1e7 * direction);
        ASSERT_TRUE(prepared);
        const auto isVisible = [&](const RealVector& p) {
            return halfLineMissesOccluder(wgs84(), kDepth, p, real(-direction));
        };
        EXPECT_GE(percentFound(random, trial % 4, isVisible, *prepared), kBar);
    }
}

// The lemma of the occluder: every point of it lies `depth` or more below the ellipsoid.
TEST(Horizon, OccluderLiesBelowTheParallelSurface) {
    Random random(305);
    for (int trial = 0; trial < 20000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const double depth = random.uniform(-9000.0, 60000.0);
        const double least = smaller(ellipsoid), most = larger(ellipsoid);
        const Real scale = 1 - static_cast<Real>(depth) / (depth >= 0.0 ? least : most);
        const RealVector surface =
            geodeticToEcef(ellipsoid, random.uniform(-kHalfPi, kHalfPi), random.uniform(-kPi, kPi), 0);
        const RealGeodetic position = ecefToGeodetic(ellipsoid, scale * surface);
        ASSERT_LE(position.altitude, -depth + 1e-6) << depth;
        // and it is no smaller than it has to be
        ASSERT_GE(position.altitude, -depth * (depth > 0.0 ? most / least : least / most) - 1e-6);
    }
}

TEST(Horizon, MissingInformationIsVisible) {
    const auto fromEye = [](double depth, const glm::dvec3& eye) {
        return HorizonEye::fromEye(wgs84(), depth, eye).has_value();
    };
    const glm::dvec3 eye(1e7, 0.0, 0.0);
    EXPECT_TRUE(fromEye(kDepth, eye));
    EXPECT_TRUE(fromEye(-100.0, eye)) << "all terrain above the ellipsoid";
    EXPECT_FALSE(fromEye(kNaN, eye));
    EXPECT_FALSE(fromEye(kInfinity, eye));
    EXPECT_FALSE(fromEye(6e6, eye));
    EXPECT_FALSE(fromEye(kDepth, {kNaN, 0.0, 0.0}));
    EXPECT_FALSE(fromEye(kDepth, {kInfinity, 0.0, 0.0}));
    EXPECT_FALSE(fromEye(kDepth, glm::dvec3(0.0)));
    EXPECT_FALSE(fromEye(kDepth, onWgs84(10.0, 20.0, -kDepth - 100.0))) << "inside the occluder";
    EXPECT_TRUE(fromEye(kDepth, onWgs84(10.0, 20.0, -kDepth + 1.0)));
    EXPECT_FALSE(hides(eye, GeodeticBin())) << "an empty bin";
    EXPECT_FALSE(hides(eye, square(0.0, 179.0, 1.0), kDepth, kNaN));
    EXPECT_FALSE(hides(eye, square(0.0, 179.0, 1.0, {-4e6, 0.0}))) << "nearer the centre than altitudes go";
    EXPECT_TRUE(hides(eye, square(0.0, 179.0, 1.0)));
}

TEST(Horizon, NearPlaneBehindTheFrontOfTheOccluderHidesNothing) {
    const glm::dvec3 view(0.0, 0.0, -1.0);
    const auto active = [&](double z) {
        return HorizonEye::fromDirection(wgs84(), kDepth, view, {0.0, 0.0, z}).has_value();
    };
    EXPECT_TRUE(active(6.4e6));
    EXPECT_FALSE(active(6.3e6));
    EXPECT_FALSE(active(-1e7));
    EXPECT_FALSE(HorizonEye::fromDirection(wgs84(), kDepth, glm::dvec3(0.0), {0.0, 0.0, 1e7}));
    EXPECT_FALSE(HorizonEye::fromDirection(wgs84(), kDepth, {0.0, kNaN, 1.0}, {0.0, 0.0, 1e7}));
}

TEST(Horizon, MarginHidesLess) {
    Random random(306);
    int changed = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const GeodeticBin bin = randomTile(random, random.integer(0, 6), {-500.0, 3000.0});
        const glm::dvec3 eye =
            onWgs84(random.uniform(-90.0, 90.0), random.uniform(-180.0, 180.0), random.logUniform(1e5, 1e9));
        const double margin = random.logUniform(1e-3, 1e7);
        const bool bare = hides(eye, bin), grown = hides(eye, bin, kDepth, margin);
        ASSERT_TRUE(bare || !grown);
        changed += bare != grown ? 1 : 0;
    }
    EXPECT_GT(changed, 100);
    // it reaches around the globe
    EXPECT_FALSE(hides(onWgs84(0.0, 0.0, 1e9), square(0.0, 179.5, 1.0, {5e6, 5e6}), kDepth, 8e6));
}

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

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracles: long double evaluation, one published worked example, finite differences, dense sampling. And the truth that
// the other tests lean on is itself tested: the closed form against sampling and climbing, the inverse mapping against
// the mapping. Of remainders: finite differences of the long double mapping; first and second derivatives are tested in
// mappings/, against those by automatic differentiation, and by what QuadraticBin makes of them.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// toEcef: some ten roundings of quantities as large as the coordinates.
constexpr double kMappingRounding = 16.0 * kEpsilon;
// Far away the rounding of the angles themselves, an ulp of pi and one of pi/2, is more than that.
constexpr double kRoundTripAngle = 3.0 * kEpsilon;

// Polar radius over equatorial radius, as far as toGeodetic() promises anything.
constexpr std::array<double, 2> kEndsOfRatio{0.01, 100.0};

double distanceBetween(const glm::dvec3& a, const RealVector& b) {
    return static_cast<double>(length(real(a) - b));
}

TEST(Ellipsoid, ConvertsThePublishedExample) {
    // The worked example of geographic/geocentric conversion, EPSG method 9602 [EPSG].
    const auto dms = [](double d, double m, double s) { return (d + m / 60.0 + s / 3600.0) * kRadiansPerDegree; };
    const Geodetic position{dms(53, 48, 33.82), dms(2, 7, 46.38), 73.0};
    const glm::dvec3 published(3771793.97, 140253.34, 5124304.35);
    constexpr double kPublishedTo = 0.0051;  // the result is given in centimetres
    const glm::dvec3 ecef = wgs84().toEcef(position);
    EXPECT_NEAR(ecef.x, published.x, kPublishedTo);
    EXPECT_NEAR(ecef.y, published.y, kPublishedTo);
    EXPECT_NEAR(ecef.z, published.z, kPublishedTo);
}

TEST(Ellipsoid, PolesHaveLongitudeZero) {
    const Ellipsoid earth = wgs84();
    for (const double side : {1.0, -1.0}) {
        const Geodetic pole = earth.toGeodetic({0.0, 0.0, side * (earth.polarRadius() + 250.0)});
        EXPECT_EQ(pole.latitude, side * kHalfPi);
        EXPECT_EQ(pole.longitude, 0.0);
        EXPECT_NEAR(pole.altitude, 250.0, 1e-8);
    }
}

// From disks to needles, at any depth: where normals cross, the nearest of several positions is taken.
Ellipsoid flatOrLong(Random& random) {
    if (random.chance(0.3)) return wgs84();
    const double ratio = random.chance(0.2) ? random.pick(kEndsOfRatio) : random.logUniform(0.01, 100.0);
    return Ellipsoid(6378137.0, 6378137.0 * ratio);
}

double largestCurvatureRadius(const Ellipsoid& ellipsoid) {
    return larger(ellipsoid) * larger(ellipsoid) / smaller(ellipsoid);
}

TEST(Ellipsoid, ConvertsLikeLongDouble) {
    Random random(14);
    for (int trial = 0; trial < 100000; ++trial) {
        const Ellipsoid ellipsoid = flatOrLong(random);
        const double most = larger(ellipsoid);
        const double latitude = random.sign() * (random.chance(0.5) ? random.uniform(0.0, kHalfPi)
                                                                    : kHalfPi - random.logUniform(1e-9, 1.0));
        const Geodetic position{latitude, random.uniform(-kPi, kPi), random.uniform(-1.0, 1.0) * most};
        ASSERT_LE(distanceBetween(ellipsoid.toEcef(position), geodeticToEcef(ellipsoid, position)),
                  kMappingRounding * (most + std::abs(position.altitude)));
    }
}

TEST(Ellipsoid, ReturnsToTheSamePointOnDisksAndNeedles) {
    Random random(15);
    double worst = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const Ellipsoid ellipsoid = flatOrLong(random);
        const double most = larger(ellipsoid);
        glm::dvec3 point = random.direction();
        if (random.chance(0.5)) point *= glm::dvec3(ellipsoid.equatorialRadius(), 1.0, ellipsoid.polarRadius()) / most;
        if (random.chance(0.1)) point.z *= random.logUniform(1e-300, 1.0);
        if (random.chance(0.1)) point *= glm::dvec3(random.logUniform(1e-300, 1.0), 1e-300, 1.0);
        if (random.chance(0.1)) point[random.integer(0, 2)] = 0.0;
        point *= most * (random.chance(0.5) ? random.uniform(0.0, 1.5) : random.logUniform(1e-12, 1e3));
        const Geodetic position = ellipsoid.toGeodetic(point);
        ASSERT_LE(std::abs(position.latitude), kHalfPi);
        ASSERT_LE(std::abs(position.longitude), kPi);
        const double error = distanceBetween(point, geodeticToEcef(ellipsoid, position));
        worst = std::max(worst, error / (largestCurvatureRadius(ellipsoid) + glm::length(point)));
        // the nearest point of the surface is as far away as the surface is deep there
        const glm::dvec3 onSurface = most * random.direction() *
                                     glm::dvec3(ellipsoid.equatorialRadius() / most,
                                                ellipsoid.equatorialRadius() / most, ellipsoid.polarRadius() / most);
        ASSERT_LE(std::abs(position.altitude), glm::distance(point, onSurface) * (1.0 + 1e-12) + 1e-8) << trial;
    }
    std::printf("round trip from disks to needles: %.2g of the distance and the largest radius of curvature\n", worst);
    EXPECT_LE(worst, kRoundTripAngle);
}

// Down to the centres of curvature a position is one of its own, and comes back.
TEST(Ellipsoid, ReturnsToTheSamePositionAboveTheCentresOfCurvature) {
    Random random(16);
    for (int trial = 0; trial < 100000; ++trial) {
        const Ellipsoid ellipsoid = flatOrLong(random);
        const double smallest = smallestCurvatureRadius(ellipsoid);
        const double above = random.chance(0.5) ? random.logUniform(1e-9, 1.0) : random.uniform(0.0, 3.0);
        const Geodetic position{random.uniform(-kHalfPi, kHalfPi), random.uniform(-3.0, 3.0), smallest * (above - 1.0)};
        const RealVector exact = geodeticToEcef(ellipsoid, position);
        const Geodetic returned = ellipsoid.toGeodetic(rounded(exact));
        const double room = 4.0 * kEpsilon * (largestCurvatureRadius(ellipsoid) + static_cast<double>(length(exact)));
        ASSERT_NEAR(returned.altitude, position.altitude, room) << trial;
        const double sine = std::sin(position.latitude);
        const double height = ellipsoid.meridionalRadius(sine, std::cos(position.latitude)) + position.altitude;
        ASSERT_LE(std::abs(returned.latitude - position.latitude) * height, 2.0 * room) << trial;
    }
}

TEST(Ellipsoid, RadiiOfCurvatureAreThoseOfTheSurface) {
    Random random(12);
    constexpr Real kStep = 1e-4L;
    for (int trial = 0; trial < 2000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const double latitude = random.uniform(-1.5, 1.5);
        const RealVector at = geodeticToEcef(ellipsoid, latitude, 0, 0);
        const Real along = length(geodeticToEcef(ellipsoid, latitude + kStep, 0, 0) -
                                  geodeticToEcef(ellipsoid, latitude - kStep, 0, 0)) /
                           (2 * kStep);
        const double sine = std::sin(latitude), cosine = std::cos(latitude);
        ASSERT_NEAR(ellipsoid.meridionalRadius(sine, cosine) / static_cast<double>(along), 1.0, 1e-8);
        ASSERT_NEAR(ellipsoid.primeVerticalRadius(sine, cosine) * cosine, static_cast<double>(at.x), 1e-8);
    }
}

TEST(Ellipsoid, SupportIsTheLargestProjection) {
    Random random(13);
    for (int trial = 0; trial < 200; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const glm::dvec3 direction = random.direction();
        const core::GeodeticBin globe = core::GeodeticBin::wholeGlobe({0.0, 0.0});
        const double support = ellipsoid.support(direction);
        ASSERT_NEAR(support, static_cast<double>(sampledDistanceRange(ellipsoid, globe, {direction, 0.0}, 16).upper),
                    1e-6);
        ASSERT_NEAR(ellipsoid.support(3.0 * direction), 3.0 * support, 1e-7);
    }
}

TEST(Ellipsoid, IsFlattenedRoundOrProlate) {
    EXPECT_EQ(Ellipsoid(5.0, 5.0).eccentricitySquared(), 0.0);
    EXPECT_NEAR(wgs84().eccentricitySquared(), 0.00669437999014, 1e-14);
    EXPECT_NEAR(Ellipsoid(4.0, 5.0).eccentricitySquared(), 1.0 - 25.0 / 16.0, 1e-15);
    EXPECT_TRUE(Ellipsoid(4.0, 5.0) == Ellipsoid(4.0, 5.0));
    EXPECT_TRUE(Ellipsoid(4.0, 5.0) != Ellipsoid(5.0, 4.0));
}

// What climbing leaves below the true extremum, as a share of the bin's size: its last step is 2^-24 of a cell, in
// altitude or at an end as well, where the bin's edge is met exactly.
constexpr double kClimbingError = 1e-10;

TEST(GeodeticOracle, ClosedFormHoldsEverySampleAndIsReached) {
    Random random(1);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const BinKind kind = random.pick(kBinKinds);
        const BinOracle oracle(ellipsoid, randomBin(random, kind));
        const core::Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const RealRange truth = oracle.distanceRange(plane);
        const RealRange sampled = sampledDistanceRange(ellipsoid, oracle.bin(), plane, 8);
        const Real rounding = oracle.rounding(plane);
        ASSERT_LE(truth.lower, sampled.lower + rounding) << nameOf(kind);
        ASSERT_GE(truth.upper, sampled.upper - rounding) << nameOf(kind);
        const double size = sizeOf(ellipsoid, oracle.bin());
        const Real gap = std::max(sampled.lower - truth.lower, truth.upper - sampled.upper) - rounding;
        worst = std::max(worst, static_cast<double>(gap) / size);
        ASSERT_LE(gap, kClimbingError * size) << nameOf(kind);
    }
    RecordProperty("largestGapPerSize", std::to_string(worst));
}

TEST(GeodeticOracle, InverseReturnsToTheSamePoint) {
    Random random(2);
    for (int trial = 0; trial < 4000; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const RealVector point = real(random.direction() * random.uniform(0.9, 1.1) * ellipsoid.equatorialRadius());
        const RealGeodetic position = ecefToGeodetic(ellipsoid, point);
        const RealVector back = geodeticToEcef(ellipsoid, position.latitude, position.longitude, position.altitude);
        ASSERT_LE(length(back - point), 1e-11L);
    }
}

using core::ParameterBox;

// The length of D3f(x)[e, e, e], by differences whose reach in angle is a hundredth of a radian.
double thirdDifferential(const Ellipsoid& ellipsoid, const glm::dvec3& at, const glm::dvec3& e) {
    const Real t = 0.01L / std::max({std::abs(e.x), std::abs(e.y), 1e-9});
    const auto along = [&](Real k) {
        return geodeticToEcef(ellipsoid, at.x + k * t * e.x, at.y + k * t * e.y, at.z + k * t * e.z) -
               geodeticToEcef(ellipsoid, at.x - k * t * e.x, at.y - k * t * e.y, at.z - k * t * e.z);
    };
    return static_cast<double>(length((1 / (8 * t * t * t)) * (8 * along(2) - 13 * along(1) - along(3))));
}

glm::dvec3 randomStep(Random& random, const glm::dvec3& halfSize) {
    const bool corner = random.chance(0.7);
    const auto factor = [&] { return corner ? random.sign() : random.uniform(-1.0, 1.0); };
    return {factor() * halfSize.x, factor() * halfSize.y, factor() * halfSize.z};
}

glm::dvec3 randomParameters(Random& random, const GeodeticBin& bin) {
    const core::Geodetic position = randomPosition(random, bin);
    return {position.latitude, position.longitude, position.altitude};
}

TEST(GeodeticMapping, RemainderHolds) {
    // Differences err by 1e-7 of the differential, and by rounding: 1e-5 m at 0.01 radians, scaled to the box.
    constexpr double kTruncation = 1e-6;
    Random random(42);
    for (int trial = 0; trial < 20000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const BinKind kind = random.pick(kBinKinds);
        const GeodeticBin bin = randomBin(random, kind);
        const ParameterBox box = core::parameterBox(bin);
        const double bound = 6.0 * GeodeticMapping(ellipsoid).remainder(box);
        const double reach = std::max(box.halfSize.x, box.halfSize.y) / 0.01;
        const double rounding = 1e-5 * reach * reach * reach + 1e-9;
        if (box.halfSize.z > 1e3 * 6e6 * std::max(box.halfSize.x, box.halfSize.y)) continue;  // towers: no differences
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 at = randomParameters(random, bin);
            const double actual = thirdDifferential(ellipsoid, at, randomStep(random, box.halfSize));
            ASSERT_LE(actual, bound * (1.0 + kTruncation) + rounding) << nameOf(kind);
        }
    }
}

// A box a nanoradian from the pole: its cosine of latitude must not drown in 1 - sin2.
TEST(GeodeticMapping, RemainderHoldsBesideTheAxis) {
    const Ellipsoid earth = wgs84();
    for (const double distance : {1e-3, 1e-6, 1e-7, 1e-8, 3e-9, 1e-9, 1e-12}) {
        const GeodeticBin bin({kHalfPi - distance, kHalfPi}, {0.0, kPi}, {0.0, 0.0});
        const ParameterBox box = core::parameterBox(bin);
        const double eastward = std::pow(box.halfSize.y, 3) * 6.3e6 * distance;  // f_lll at the southern edge
        EXPECT_GE(6.0 * GeodeticMapping(earth).remainder(box), 0.99 * eastward) << distance;
    }
}

TEST(GeodeticMapping, RemainderIsTight) {
    // The bound adds the largest of each term; the truth is at one place, for one step.
    constexpr double kLooseness = 2.0;
    Random random(43);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        const Ellipsoid ellipsoid = wgs84();
        const GeodeticBin bin = randomTile(random, random.integer(0, 6), {-500.0, 9000.0});
        const ParameterBox box = core::parameterBox(bin);
        double largest = 0.0;
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 at = randomParameters(random, bin);
            largest = std::max(largest, thirdDifferential(ellipsoid, at, randomStep(random, box.halfSize)));
        }
        worst = std::max(worst, 6.0 * GeodeticMapping(ellipsoid).remainder(box) / largest);
    }
    std::printf("six remainders / largest third differential found: at most %.2f\n", worst);
    EXPECT_LE(worst, kLooseness);
}

TEST(GeodeticMapping, ParameterBoxHoldsTheBin) {
    Random random(46);
    for (int trial = 0; trial < 100000; ++trial) {
        const GeodeticBin bin = randomBin(random);
        const ParameterBox box = core::parameterBox(bin);
        const std::array<core::Interval, 3> intervals{bin.latitude(), bin.longitude(), bin.altitude()};
        for (int i = 0; i < 3; ++i) {
            const core::Interval& interval = intervals[static_cast<std::size_t>(i)];
            ASSERT_LE(static_cast<Real>(box.center[i]) - box.halfSize[i], interval.lower);
            ASSERT_GE(static_cast<Real>(box.center[i]) + box.halfSize[i], interval.upper);
            ASSERT_LE(box.halfSize[i], 0.5 * interval.width() * (1.0 + 1e-12) + 1e-15 * std::abs(interval.upper));
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: long double evaluation, one published worked example, finite differences, dense sampling.

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::Geodetic;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// toEcef: some ten roundings of quantities as large as the coordinates.
constexpr double kMappingRounding = 16.0 * kEpsilon;
constexpr double kRoundTripError = 1e-8;  // promised by Ellipsoid::toGeodetic
// Far away the rounding of the angles themselves, an ulp of pi and one of pi/2, is more than that.
constexpr double kRoundTripAngle = 3.0 * kEpsilon;

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

TEST(Ellipsoid, ConvertsLikeLongDouble) {
    Random random(10);
    for (int trial = 0; trial < 100000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const Geodetic position{random.uniform(-kHalfPi, kHalfPi), random.uniform(-2 * kPi, 2 * kPi),
                                random.uniform(-11000.0, 1e7)};
        ASSERT_LE(distanceBetween(ellipsoid.toEcef(position), geodeticToEcef(ellipsoid, position)),
                  kMappingRounding * (7e6 + std::abs(position.altitude)));
    }
}

TEST(Ellipsoid, AxesAreWhereTheyShouldBe) {
    const Ellipsoid earth = wgs84();
    EXPECT_EQ(earth.toEcef({0.0, 0.0, 0.0}), glm::dvec3(earth.equatorialRadius(), 0.0, 0.0));
    EXPECT_NEAR(earth.toEcef({0.0, kHalfPi, 100.0}).y, earth.equatorialRadius() + 100.0, 1e-8);
    EXPECT_NEAR(earth.toEcef({kHalfPi, 0.3, 100.0}).z, earth.polarRadius() + 100.0, 1e-8);
    EXPECT_NEAR(earth.toEcef({-kHalfPi, 0.3, 0.0}).z, -earth.polarRadius(), 1e-8);
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

// The promise covers earth-like ellipsoids, 5000 km below the surface and up.
TEST(Ellipsoid, ReturnsToTheSamePoint) {
    Random random(11);
    double worstNear = 0.0;
    double worstFar = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const double radius = random.uniform(1.36e6, 7e6);
        const Ellipsoid ellipsoid =
            random.chance(0.5) ? wgs84()
                               : Ellipsoid(6378137.0, 6378137.0 * std::sqrt(1.0 - random.uniform(-0.0099, 0.0099)));
        const bool far = random.chance(0.5);
        glm::dvec3 direction = random.direction();
        if (random.chance(0.1))
            direction = glm::normalize(glm::dvec3(direction.x * 1e-9, direction.y * 1e-9, direction.z));
        if (random.chance(0.1)) direction = glm::normalize(glm::dvec3(direction.x, direction.y, direction.z * 1e-9));
        if (random.chance(0.1)) direction = glm::normalize(glm::dvec3(-1.0, direction.y * 1e-9, direction.z));
        const double distance = far ? random.logUniform(7e6, 1e8) : radius;
        const glm::dvec3 point = direction * distance;
        if (!far && glm::length(point) < ellipsoid.polarRadius() - 5e6) continue;
        const Geodetic position = ellipsoid.toGeodetic(point);
        ASSERT_LE(std::abs(position.latitude), kHalfPi);
        ASSERT_LE(std::abs(position.longitude), kPi);
        const double error = distanceBetween(point, geodeticToEcef(ellipsoid, position));
        double& worst = far ? worstFar : worstNear;
        worst = std::max(worst, error / (far ? distance : 1.0));
    }
    std::printf("round trip: %.2g m to 7000 km from the centre, %.2g times the distance to 1e5 km\n", worstNear,
                worstFar);
    EXPECT_LE(worstNear, kRoundTripError);
    EXPECT_LE(worstFar, kRoundTripAngle);
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
        const double sine = std::sin(latitude);
        ASSERT_NEAR(ellipsoid.meridionalRadius(sine) / static_cast<double>(along), 1.0, 1e-8);
        ASSERT_NEAR(ellipsoid.primeVerticalRadius(sine) * std::cos(latitude), static_cast<double>(at.x), 1e-8);
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

}  // namespace
}  // namespace osgAnalyticBin::test

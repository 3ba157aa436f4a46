// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the same form in long double, which shares no code (tested itself in EllipsoidTest), samples of the
// bin. Ten million more pairs of bin and plane: Soundness.cpp. Many planes at once: PlaneSetTest.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

// Documented at ExactGeodeticBin::distanceRange.
constexpr double kTightness = 64.0 * std::numeric_limits<double>::epsilon();

ExactGeodeticBin exactWithMargin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) {
    return ExactGeodeticBin(ellipsoid, bin, margin);
}

ExactGeodeticBin exact(const PlaneCase& c) {
    return ExactGeodeticBin(c.oracle.ellipsoid(), c.oracle.bin());
}

// What a few roundings of coordinates and offset come to, in metres.
double tolerance(const PlaneCase& c) {
    const Interval& altitude = c.oracle.bin().altitude();
    const double magnitude =
        larger(c.oracle.ellipsoid()) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
    return kTightness * (magnitude + std::abs(c.plane.offset));
}

TEST(ExactGeodeticBin, IsTightToRoundingAndDecidesAllButTies) {
    Random random(101);
    double largest = 0.0;
    for (int trial = 0; trial < 500000; ++trial) {
        const PlaneCase c(random);
        const Interval range = exact(c).distanceRange(c.plane);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        ASSERT_TRUE(holds(range, truth, c.oracle.rounding(c.plane))) << nameOf(c.kind) << " trial " << trial;
        const Real excess = std::max(truth.lower - range.lower, range.upper - truth.upper);
        ASSERT_LE(excess, tolerance(c)) << nameOf(c.kind) << " trial " << trial;
        // without the allowance for rounding, that is
        const double epsilons = static_cast<double>(excess) / tolerance(c) * 64.0 - 32.0;
        largest = std::max(largest, std::abs(epsilons));
        if (trial % 2 != 0 || std::min(std::abs(truth.lower), std::abs(truth.upper)) < tolerance(c)) continue;
        const Side expected = truth.upper < 0 ? Side::Outside : (truth.lower > 0 ? Side::Inside : Side::Straddling);
        ASSERT_EQ(exact(c).classify(c.plane), expected) << nameOf(c.kind);
    }
    std::printf("largest error of the closed form in double: %.2f epsilon (allowed 32)\n", largest);
}

// Wide bins, where the arcs meet and where half a turn is exceeded or just reached.
TEST(ExactGeodeticBin, HoldsAtHalfAndWholeTurns) {
    Random random(103);
    constexpr std::array<double, 5> kWidths{kHalfPi, kPi, 1.5 * kPi, 2.0 * kPi, 0.0};
    for (int trial = 0; trial < 200000; ++trial) {
        const double nearly = random.chance(0.3) ? 0.0 : random.sign() * random.logUniform(1e-16, 1e-3);
        const double west = random.chance(0.3) ? -kPi : random.uniform(-kPi, kPi);
        const double width = std::max(0.0, random.pick(kWidths) + nearly);
        const double south = random.uniform(-kHalfPi, kHalfPi);
        const GeodeticBin bin({south, random.uniform(south, kHalfPi)}, {west, west + width}, randomAltitude(random));
        const BinOracle oracle(randomEllipsoid(random), bin);
        const double along = west + width * 0.25 * random.integer(0, 4) + random.chance(0.5) * kPi;
        const glm::dvec3 normal = glm::normalize(
            glm::dvec3(std::cos(along), std::sin(along), random.chance(0.5) ? 0.0 : random.uniform(-2.0, 2.0)));
        const Plane plane{normal, 0.0};
        const Interval range = ExactGeodeticBin(oracle.ellipsoid(), bin).distanceRange(plane);
        ASSERT_TRUE(holds(range, oracle.distanceRange(plane), oracle.rounding(plane))) << width;
    }
}

// The width of such bins is exact, but their middle is rounded.
TEST(ExactGeodeticBin, HoldsManyTurnsAway) {
    Random random(115);
    for (int trial = 0; trial < 100000; ++trial) {
        const double west = random.sign() * random.logUniform(1.0, 9.9e5);
        const double latitude = random.uniform(-1.5, 1.5);
        const GeodeticBin bin({latitude, latitude}, {west, west + random.logUniform(1e-3, 1.0)}, {0.0, 0.0});
        const Real middle = (Real{bin.longitude().lower} + bin.longitude().upper) / 2;
        const RealVector point = geodeticToEcef(wgs84(), latitude, middle, 0.0);
        Plane plane{{static_cast<double>(std::cos(middle)), static_cast<double>(std::sin(middle)), 0.0}, 0.0};
        plane.offset = std::nextafter(static_cast<double>(-exactDistance(plane, point)), 1e9);
        ASSERT_NE(ExactGeodeticBin(wgs84(), bin).classify(plane), Side::Outside) << west;
    }
}

TEST(ExactGeodeticBin, MarginWidensTheRangeByItself) {
    Random random(104);
    expectMarginToWidenTheRangeByItself(random, exactWithMargin, tolerance);
}

TEST(ExactGeodeticBin, IsInItsSphereAndReachAndHoldsItsHullPoint) {
    Random random(105);
    for (int trial = 0; trial < 100000; ++trial) {
        const PlaneCase c(random);
        const double margin = random.chance(0.5) ? 0.0 : random.logUniform(1e-3, 1e5);
        const ExactGeodeticBin bin = exact(c), made(c.oracle.ellipsoid(), c.oracle.bin(), margin),
                               copied(made.numbers().data());
        const auto numbers = bin.numbers();
        const RealVector center{numbers[core::row::CenterX], numbers[core::row::CenterY], numbers[core::row::CenterZ]};
        for (int i = 0; i < 10; ++i) {
            const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin()));
            ASSERT_LE(length(point - center), numbers[core::row::Reach]) << nameOf(c.kind);
            ASSERT_LE(length(point + real(margin * random.direction())), std::min(made.reach(), copied.reach()));
        }
        ASSERT_LE(copied.reach(), 3.0 * made.reach()) << nameOf(c.kind);
        // where it is inside two planes, no search for a plane that parts the bin from their wedge is begun
        const double tolerance = 1e-14 * (bin.reach() + c.oracle.ellipsoid().equatorialRadius());
        for (const glm::dvec3& direction : {c.plane.normal, random.direction()})
            ASSERT_LE(glm::dot(direction, bin.hullPoint()), bin.support(direction) + tolerance) << nameOf(c.kind);
    }
}

TEST(ExactGeodeticBin, SphereIsNoLargerThanTheCornersNeed) {
    Random random(106);
    for (int level = 0; level <= kDeepestLevel; ++level) {
        for (int trial = 0; trial < 1000; ++trial) {
            const GeodeticBin bin = randomTile(random, level, kTerrainAltitudes);
            const auto numbers = ExactGeodeticBin(wgs84(), bin).numbers();
            const RealVector center{numbers[core::row::CenterX], numbers[core::row::CenterY],
                                    numbers[core::row::CenterZ]};
            Real farthest = 0;
            for (const double latitude : {bin.latitude().lower, bin.latitude().upper}) {
                for (const double altitude : {bin.altitude().lower, bin.altitude().upper}) {
                    const RealVector corner = geodeticToEcef(wgs84(), latitude, bin.longitude().lower, altitude);
                    farthest = std::max(farthest, length(corner - center));
                }
            }
            ASSERT_LE(numbers[core::row::Reach], farthest * (1 + 2e-7L) + 1e-6L) << level;
        }
    }
}

TEST(ExactGeodeticBin, PlaneWithoutNumbersIsUndecided) {
    expectPlanesWithoutNumbersToBeUndecided(exactWithMargin);
    const ExactGeodeticBin bin(wgs84(), kOneDegree);
    for (const double infinite : {kInfinity, -kInfinity})
        EXPECT_EQ(bin.classify({{infinite, 0.0, 0.0}, 0.0}), Side::Straddling);
}

// As deep as it may be taken, on ellipsoids of any flattening; the model holds below as well.
TEST(ExactGeodeticBin, HoldsDownToTheCentresOfCurvature) {
    Random random(114);
    for (int trial = 0; trial < 100000; ++trial) {
        const Ellipsoid ellipsoid = random.chance(0.5)
                                        ? randomEllipsoid(random)
                                        : Ellipsoid(6378137.0, 6378137.0 * random.logUniform(0.01, 10.0));
        const double smallest = smallestCurvatureRadius(ellipsoid);
        const double low = -smallest * (1.0 - random.logUniform(1e-16, 1.0));
        const double high = low + (random.chance(0.3) ? random.logUniform(1e-9, 1.0) : random.uniform()) * smallest;
        const GeodeticBin bin = randomBin(random).withAltitude({low, high});
        if (!ExactGeodeticBin::holds(ellipsoid, bin)) continue;
        const BinOracle oracle(ellipsoid, bin);
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const RealRange truth = oracle.distanceRange(plane);
        const Real rounding = oracle.rounding(plane);
        const ExactGeodeticBin exact(ellipsoid, bin);
        const core::QuadraticOrExact either = core::quadraticOrExact(ellipsoid, bin);
        const Side eitherSide = std::visit([&](const auto& form) { return form.classify(plane); }, either);
        const Interval eitherRange = std::visit([&](const auto& form) { return form.distanceRange(plane); }, either);
        for (const Side side : {exact.classify(plane), eitherSide}) {
            ASSERT_FALSE(side == Side::Outside && truth.upper >= rounding) << trial;
            ASSERT_FALSE(side == Side::Inside && truth.lower < -rounding) << trial;
        }
        for (const Interval& range : {exact.distanceRange(plane), eitherRange})
            ASSERT_TRUE(holds(range, truth, rounding)) << trial;
    }
}

TEST(ExactGeodeticBin, HoldsOnlyAboveTheCentresOfCurvature) {
    const Interval degree{0.0, 1.0};
    EXPECT_TRUE(ExactGeodeticBin::holds(wgs84(), GeodeticBin::fromDegrees(degree, degree, {-6.3e6, 0.0})));
    EXPECT_FALSE(ExactGeodeticBin::holds(wgs84(), GeodeticBin::fromDegrees(degree, degree, {-6.36e6, 0.0})));
    EXPECT_FALSE(ExactGeodeticBin::holds(wgs84(), GeodeticBin()));
}

}  // namespace
}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the same form in long double, which shares no code (tested itself in GeodeticOracleTest), samples of the
// bin, the second-order model, relations. Ten million more pairs of bin and plane: Soundness.cpp. Many planes at once:
// PlaneSetTest.

#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <support/Numbers.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::Interval;
using core::Plane;
using core::Side;

// Documented at ExactGeodeticBin::distanceRange.
constexpr double kTightness = 64.0 * std::numeric_limits<double>::epsilon();

struct Case {
    explicit Case(Random& random) : Case(random, random.pick(kBinKinds)) {}
    Case(Random& random, BinKind binKind)
        : kind(binKind),
          oracle(randomEllipsoid(random), randomBin(random, kind)),
          plane(randomPlane(random, oracle, random.pick(kPlaneKinds))) {}

    [[nodiscard]] ExactGeodeticBin exact(double margin = 0.0) const {
        return ExactGeodeticBin(oracle.ellipsoid(), oracle.bin(), margin);
    }
    // What a few roundings of coordinates and offset come to, in metres.
    [[nodiscard]] double tolerance() const { return kTightness * (magnitude() + std::abs(plane.offset)); }
    [[nodiscard]] double magnitude() const {
        const Interval& altitude = oracle.bin().altitude();
        return std::max(oracle.ellipsoid().equatorialRadius(), oracle.ellipsoid().polarRadius()) +
               std::max(std::abs(altitude.lower), std::abs(altitude.upper));
    }

    BinKind kind;
    BinOracle oracle;
    Plane plane;
};

TEST(ExactGeodeticBin, NeverContradictsASample) {
    Random random(100);
    std::array<int, 3> verdicts{};
    for (int trial = 0; trial < 20000; ++trial) {
        const Case c(random);
        const Side side = c.exact().classify(c.plane);
        ++verdicts[static_cast<std::size_t>(side)];
        if (side == Side::Straddling) continue;
        for (int i = 0; i < 30; ++i) {
            const Real distance =
                exactDistance(c.plane, geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin())));
            if (side == Side::Outside) {
                ASSERT_LT(distance, 0) << nameOf(c.kind);
            }
            if (side == Side::Inside) {
                ASSERT_GE(distance, 0) << nameOf(c.kind);
            }
        }
    }
    for (const int count : verdicts) EXPECT_GT(count, 1000) << "every verdict must occur, or nothing is tested";
}

TEST(ExactGeodeticBin, IsTightToRounding) {
    Random random(101);
    double largest = 0.0;
    for (int trial = 0; trial < 500000; ++trial) {
        const Case c(random);
        const Interval range = c.exact().distanceRange(c.plane);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        const Real rounding = c.oracle.rounding(c.plane);
        ASSERT_LE(range.lower, truth.lower + rounding) << nameOf(c.kind) << " trial " << trial;
        ASSERT_GE(range.upper, truth.upper - rounding) << nameOf(c.kind) << " trial " << trial;
        const Real excess = std::max(truth.lower - range.lower, range.upper - truth.upper);
        ASSERT_LE(excess, c.tolerance()) << nameOf(c.kind) << " trial " << trial;
        // without the allowance for rounding, that is
        const double epsilons = static_cast<double>(excess) / c.tolerance() * 64.0 - 32.0;
        largest = std::max(largest, std::abs(epsilons));
    }
    std::printf("largest error of the closed form in double: %.2f epsilon (allowed 32)\n", largest);
}

TEST(ExactGeodeticBin, DecidesAllButTies) {
    Random random(102);
    for (int trial = 0; trial < 200000; ++trial) {
        const Case c(random);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        if (std::min(std::abs(truth.lower), std::abs(truth.upper)) < c.tolerance()) continue;
        const Side expected = truth.upper < 0 ? Side::Outside : (truth.lower > 0 ? Side::Inside : Side::Straddling);
        ASSERT_EQ(c.exact().classify(c.plane), expected) << nameOf(c.kind);
    }
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
        const RealRange truth = oracle.distanceRange(plane);
        ASSERT_LE(range.lower, truth.lower + oracle.rounding(plane)) << width;
        ASSERT_GE(range.upper, truth.upper - oracle.rounding(plane)) << width;
    }
}

TEST(ExactGeodeticBin, MarginWidensTheRangeByItself) {
    Random random(104);
    for (int trial = 0; trial < 50000; ++trial) {
        const Case c(random);
        const double margin = random.logUniform(1e-3, 1e5);
        const ExactGeodeticBin wide = c.exact(margin);
        const double tolerance = 2e-9 * margin + c.tolerance();
        ASSERT_NEAR(c.exact().distanceRange(c.plane).lower - wide.distanceRange(c.plane).lower, margin, tolerance);
        ASSERT_NEAR(wide.distanceRange(c.plane).upper - c.exact().distanceRange(c.plane).upper, margin, tolerance);
        const Side side = wide.classify(c.plane);
        if (side == Side::Straddling) continue;
        const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin())) +
                                 real(margin * 0.999999 * random.direction());
        if (side == Side::Outside) {
            ASSERT_LT(exactDistance(c.plane, point), 0);
        }
        if (side == Side::Inside) {
            ASSERT_GE(exactDistance(c.plane, point), 0);
        }
    }
}

TEST(ExactGeodeticBin, SphereHoldsTheBin) {
    Random random(105);
    for (int trial = 0; trial < 100000; ++trial) {
        const Case c(random);
        const core::ExactBinData data = c.exact().data();
        const RealVector center{data.sphere.center[0], data.sphere.center[1], data.sphere.center[2]};
        for (int i = 0; i < 10; ++i) {
            const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin()));
            ASSERT_LE(length(point - center), data.sphere.reach) << nameOf(c.kind);
        }
    }
}

TEST(ExactGeodeticBin, SphereIsNoLargerThanTheCornersNeed) {
    Random random(106);
    for (int level = 0; level <= kDeepestLevel; ++level) {
        for (int trial = 0; trial < 1000; ++trial) {
            const GeodeticBin bin = randomTile(random, level, kTerrainAltitudes);
            const core::ExactBinData data = ExactGeodeticBin(wgs84(), bin).data();
            const RealVector center{data.sphere.center[0], data.sphere.center[1], data.sphere.center[2]};
            Real farthest = 0;
            for (const double latitude : {bin.latitude().lower, bin.latitude().upper}) {
                for (const double altitude : {bin.altitude().lower, bin.altitude().upper}) {
                    const RealVector corner = geodeticToEcef(wgs84(), latitude, bin.longitude().lower, altitude);
                    farthest = std::max(farthest, length(corner - center));
                }
            }
            ASSERT_LE(data.sphere.reach, farthest * (1 + 2e-7L) + 1e-6L) << level;
        }
    }
}

TEST(ExactGeodeticBin, PlaneWithoutNumbersIsUndecided) {
    const ExactGeodeticBin bin(wgs84(), GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0}));
    for (int broken = 0; broken < 4; ++broken) {
        Plane plane{{1.0, 0.0, 0.0}, -1e9};
        ASSERT_EQ(bin.classify(plane), Side::Outside);
        (broken < 3 ? plane.normal[broken] : plane.offset) = kNaN;
        EXPECT_EQ(bin.classify(plane), Side::Straddling) << broken;
        EXPECT_EQ(bin.classify(plane.flipped()), Side::Straddling) << broken;
    }
    for (const double offset : {kInfinity, -kInfinity}) {
        EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, offset}), Side::Straddling);
        EXPECT_EQ(bin.classify({{offset, 0.0, 0.0}, 0.0}), Side::Straddling);
    }
}

TEST(ExactGeodeticBin, FlippingThePlaneFlipsTheRange) {
    Random random(107);
    for (int trial = 0; trial < 50000; ++trial) {
        const Case c(random);
        const Interval range = c.exact().distanceRange(c.plane);
        const Interval flipped = c.exact().distanceRange(c.plane.flipped());
        ASSERT_EQ(flipped.lower, -range.upper);
        ASSERT_EQ(flipped.upper, -range.lower);
    }
}

void expectSameRange(const Interval& a, const Interval& b, double tolerance) {
    ASSERT_NEAR(a.lower, b.lower, tolerance);
    ASSERT_NEAR(a.upper, b.upper, tolerance);
}

TEST(ExactGeodeticBin, TurnsWithTheEarth) {
    Random random(108);
    for (int trial = 0; trial < 50000; ++trial) {
        const Case c(random);
        const GeodeticBin& bin = c.oracle.bin();
        const double turn = random.uniform(-kPi, kPi);
        const GeodeticBin turned(bin.latitude(), {bin.longitude().lower + turn, bin.longitude().upper + turn},
                                 bin.altitude());
        const glm::dvec3& n = c.plane.normal;
        const Plane plane{
            {n.x * std::cos(turn) - n.y * std::sin(turn), n.x * std::sin(turn) + n.y * std::cos(turn), n.z},
            c.plane.offset};
        expectSameRange(ExactGeodeticBin(c.oracle.ellipsoid(), turned).distanceRange(plane),
                        c.exact().distanceRange(c.plane), 2.0 * c.tolerance());
    }
}

TEST(ExactGeodeticBin, MirrorsWithTheHemispheres) {
    Random random(109);
    for (int trial = 0; trial < 50000; ++trial) {
        const Case c(random);
        const GeodeticBin& bin = c.oracle.bin();
        const GeodeticBin south({-bin.latitude().upper, -bin.latitude().lower}, bin.longitude(), bin.altitude());
        const GeodeticBin west(bin.latitude(), {-bin.longitude().upper, -bin.longitude().lower}, bin.altitude());
        const Interval range = c.exact().distanceRange(c.plane);
        const Plane downward{c.plane.normal * glm::dvec3(1.0, 1.0, -1.0), c.plane.offset};
        const Plane westward{c.plane.normal * glm::dvec3(1.0, -1.0, 1.0), c.plane.offset};
        expectSameRange(ExactGeodeticBin(c.oracle.ellipsoid(), south).distanceRange(downward), range, c.tolerance());
        expectSameRange(ExactGeodeticBin(c.oracle.ellipsoid(), west).distanceRange(westward), range, c.tolerance());
    }
}

TEST(ExactGeodeticBin, QuartersLieWithinTheirParentAndFillIt) {
    Random random(110);
    for (int trial = 0; trial < 50000; ++trial) {
        const Case c(random);
        const Interval outer = c.exact().distanceRange(c.plane);
        Interval hull{kInfinity, -kInfinity};
        for (const GeodeticBin& child : c.oracle.bin().quarters()) {
            const Interval inner = ExactGeodeticBin(c.oracle.ellipsoid(), child).distanceRange(c.plane);
            hull = {std::min(hull.lower, inner.lower), std::max(hull.upper, inner.upper)};
        }
        expectSameRange(outer, hull, 2.0 * c.tolerance());
    }
}

TEST(ExactGeodeticBin, LiesWithinTheQuadraticRange) {
    Random random(111);
    for (int trial = 0; trial < 100000; ++trial) {
        const Case c(random);
        const core::QuadraticBin model(core::GeodeticMapping(c.oracle.ellipsoid()), core::parameterBox(c.oracle.bin()));
        const Interval outer = model.distanceRange(c.plane);
        const Interval inner = c.exact().distanceRange(c.plane);
        ASSERT_GE(inner.lower, outer.lower - c.tolerance()) << nameOf(c.kind);
        ASSERT_LE(inner.upper, outer.upper + c.tolerance()) << nameOf(c.kind);
    }
}

TEST(ExactGeodeticBin, CameraInsideTheBinKeepsIt) {
    Random random(112);
    for (int trial = 0; trial < 50000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomBin(random);
        const glm::dvec3 eye = rounded(geodeticToEcef(ellipsoid, randomPosition(random, bin)));
        const glm::dvec3 normal = random.direction();
        ASSERT_EQ(ExactGeodeticBin(ellipsoid, bin).classify({normal, -glm::dot(normal, eye)}), Side::Straddling);
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

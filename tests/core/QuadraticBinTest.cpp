// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the closed form of the bin's range (tested itself in GeodeticOracleTest), samples of the bin, relations.
// Ten million more pairs of bin and plane: Soundness.cpp. The range of the polynomial: QuadraticRangeTest.

#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <support/Numbers.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::GeodeticBin;
using core::GeodeticMapping;
using core::Interval;
using core::Plane;
using core::QuadraticBin;
using core::Side;

// Two evaluations of the same geometry from other numbers differ by a few roundings of coordinates near 7e6 m.
constexpr double kSameGeometry = 1e-7;

QuadraticBin quadratic(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) {
    return QuadraticBin(GeodeticMapping(ellipsoid), core::parameterBox(bin), margin);
}

struct PlaneCase {
    explicit PlaneCase(Random& random)
        : kind(random.pick(kBinKinds)),
          oracle(randomEllipsoid(random), randomBin(random, kind)),
          plane(randomPlane(random, oracle, random.pick(kPlaneKinds))) {}

    BinKind kind;
    BinOracle oracle;
    Plane plane;
};

TEST(QuadraticBin, NeverContradictsASample) {
    Random random(60);
    std::array<int, 3> verdicts{};
    for (int trial = 0; trial < 20000; ++trial) {
        const PlaneCase c(random);
        const Side side = quadratic(c.oracle.ellipsoid(), c.oracle.bin()).classify(c.plane);
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

TEST(QuadraticBin, DistanceRangeHoldsTheTrueRange) {
    Random random(61);
    for (int trial = 0; trial < 300000; ++trial) {
        const PlaneCase c(random);
        const Interval range = quadratic(c.oracle.ellipsoid(), c.oracle.bin()).distanceRange(c.plane);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        const Real rounding = c.oracle.rounding(c.plane);
        ASSERT_LE(range.lower, truth.lower + rounding) << nameOf(c.kind) << " trial " << trial;
        ASSERT_GE(range.upper, truth.upper - rounding) << nameOf(c.kind) << " trial " << trial;
    }
}

// Wide and narrow beside the axis: a remainder that loses the smallest cosines fails here first.
TEST(QuadraticBin, DistanceRangeHoldsTheTrueRangeBesideTheAxis) {
    Random random(62);
    for (int trial = 0; trial < 100000; ++trial) {
        const double distance = random.logUniform(1e-13, 1e-5);
        const Interval latitude = random.chance(0.5)
                                      ? Interval{kHalfPi - distance, kHalfPi - random.uniform() * distance}
                                      : Interval{-kHalfPi, -kHalfPi + distance};
        const double west = random.uniform(-kPi, kPi);
        const GeodeticBin bin(latitude, {west, west + random.uniform(0.0, 2.0 * kPi)}, {0.0, random.uniform()});
        const BinOracle oracle(wgs84(), bin);
        const glm::dvec3 across = glm::normalize(random.direction() * glm::dvec3(1.0, 1.0, 1e-6));
        const Plane plane{across, 0.0};
        const Interval range = quadratic(wgs84(), bin).distanceRange(plane);
        const RealRange truth = oracle.distanceRange(plane);
        ASSERT_LE(range.lower, truth.lower + oracle.rounding(plane)) << distance;
        ASSERT_GE(range.upper, truth.upper - oracle.rounding(plane)) << distance;
    }
}

TEST(QuadraticBin, DecidesWhatItsDistanceRangeDecides) {
    Random random(63);
    for (int trial = 0; trial < 100000; ++trial) {
        const PlaneCase c(random);
        const QuadraticBin bin = quadratic(c.oracle.ellipsoid(), c.oracle.bin());
        const Interval range = bin.distanceRange(c.plane);
        if (std::min(std::abs(range.lower), std::abs(range.upper)) < kSameGeometry) continue;  // a tie
        const Side expected = range.upper < 0.0 ? Side::Outside : (range.lower > 0.0 ? Side::Inside : Side::Straddling);
        ASSERT_EQ(bin.classify(c.plane), expected) << nameOf(c.kind);
    }
}

TEST(QuadraticBin, RemainderBoundsTheModelError) {
    Random random(64);
    for (int trial = 0; trial < 50000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const BinKind kind = random.pick(kBinKinds);
        const GeodeticBin bin = randomBin(random, kind);
        const core::ParameterBox box = core::parameterBox(bin);
        const QuadraticBin model(GeodeticMapping(ellipsoid), box);
        const glm::dvec3 unit(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        const std::array<Real, 3> x{box.center.x + static_cast<Real>(unit.x) * box.halfSize.x,
                                    box.center.y + static_cast<Real>(unit.y) * box.halfSize.y,
                                    box.center.z + static_cast<Real>(unit.z) * box.halfSize.z};
        const Real error = length(real(model.modelPoint(unit)) - geodeticToEcef(ellipsoid, x[0], x[1], x[2]));
        ASSERT_LE(error, model.remainder() * (1.0 + 1e-12) + kSameGeometry) << nameOf(kind);
    }
}

// The excess of one side over the true range, per tile size, over random directions.
double largestExcess(Random& random, int level, Interval altitude, int trials) {
    double worst = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, level, altitude));
        const Plane plane{random.direction(), 0.0};
        const Interval range = quadratic(wgs84(), oracle.bin()).distanceRange(plane);
        const RealRange truth = oracle.distanceRange(plane);
        const Real excess = std::max(truth.lower - range.lower, range.upper - truth.upper);
        worst = std::max(worst, static_cast<double>(excess));
    }
    return worst / (std::ldexp(kRootTileDeg, -level) * kRadiansPerDegree * wgs84().equatorialRadius());
}

TEST(QuadraticBin, IsTight) {
    // Largest excess of either end, as a share of the tile's size along the equator, with terrain's altitudes. High
    // layers are looser: their remainder has altitude times angle squared.
    constexpr double kAtRoot = 0.03;
    constexpr double kAtSecondLevel = 0.002;
    Random random(65);
    std::printf("excess over the true range / tile size: altitudes %.0f .. %.0f m | %.0f .. %.0f m\n",
                kTerrainAltitudes.lower, kTerrainAltitudes.upper, kAllAltitudes.lower, kAllAltitudes.upper);
    for (int level = 0; level <= 6; ++level) {
        const double excess = largestExcess(random, level, kTerrainAltitudes, 40000);
        const double high = largestExcess(random, level, kAllAltitudes, 40000);
        std::printf("  %8.4f deg: %.5f %% | %.5f %%\n", std::ldexp(kRootTileDeg, -level), 100.0 * excess, 100.0 * high);
        if (level == 0) {
            EXPECT_LE(excess, kAtRoot);
        }
        if (level == 2) {
            EXPECT_LE(excess, kAtSecondLevel);
        }
    }
}

TEST(QuadraticBin, DecidesPlanesThatClearlyMiss) {
    Random random(66);
    for (int trial = 0; trial < 20000; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, kDeepestLevel), {-500.0, 9000.0}));
        const glm::dvec3 normal = random.direction();
        const RealRange along = oracle.range(normal);
        const double clearly = 0.03 * sizeOf(wgs84(), oracle.bin()) + 1e-6;
        const QuadraticBin bin = quadratic(wgs84(), oracle.bin());
        ASSERT_EQ(bin.classify({normal, -static_cast<double>(along.upper) - clearly}), Side::Outside);
        ASSERT_EQ(bin.classify({normal, -static_cast<double>(along.lower) + clearly}), Side::Inside);
        ASSERT_EQ(bin.classify({normal, -static_cast<double>((along.upper + along.lower) / 2)}), Side::Straddling);
    }
}

TEST(QuadraticBin, MarginWidensTheRangeByItself) {
    Random random(67);
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const double margin = random.logUniform(1e-3, 1e5);
        const QuadraticBin bare = quadratic(c.oracle.ellipsoid(), c.oracle.bin());
        const QuadraticBin wide = quadratic(c.oracle.ellipsoid(), c.oracle.bin(), margin);
        const double tolerance = 2e-9 * margin + 1e-15 * std::abs(c.plane.offset) + kSameGeometry;
        ASSERT_NEAR(wide.remainder() - bare.remainder(), margin, tolerance);
        ASSERT_NEAR(bare.distanceRange(c.plane).lower - wide.distanceRange(c.plane).lower, margin, tolerance);
        ASSERT_NEAR(wide.distanceRange(c.plane).upper - bare.distanceRange(c.plane).upper, margin, tolerance);
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

TEST(QuadraticBin, PlaneWithoutNumbersIsUndecided) {
    const QuadraticBin bin = quadratic(wgs84(), GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0}));
    for (int broken = 0; broken < 4; ++broken) {
        Plane plane{{1.0, 0.0, 0.0}, -1e9};
        ASSERT_EQ(bin.classify(plane), Side::Outside);
        (broken < 3 ? plane.normal[broken] : plane.offset) = kNaN;
        EXPECT_EQ(bin.classify(plane), Side::Straddling) << broken;
        EXPECT_EQ(bin.classify(plane.flipped()), Side::Straddling) << broken;
    }
    for (const double offset : {kInfinity, -kInfinity}) {
        EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, offset}), Side::Straddling);
    }
}

TEST(QuadraticBin, NormalsMayBeOffByTheTolerance) {
    Random random(68);
    for (int trial = 0; trial < 50000; ++trial) {
        PlaneCase c(random);
        c.plane.normal *= 1.0 + random.sign() * 1e-9;
        // A margin of 1000 km makes the tolerance of the normal a millimetre.
        const double margin = random.chance(0.5) ? 0.0 : 1e6;
        const Interval range = quadratic(c.oracle.ellipsoid(), c.oracle.bin(), margin).distanceRange(c.plane);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        const Real reach = margin * length(real(c.plane.normal));
        ASSERT_LE(range.lower, truth.lower - reach + c.oracle.rounding(c.plane)) << nameOf(c.kind);
        ASSERT_GE(range.upper, truth.upper + reach - c.oracle.rounding(c.plane)) << nameOf(c.kind);
    }
}

void expectSameRangeBeyond(const Interval& a, const Interval& b, double offset) {
    const double tolerance = kSameGeometry + 1e-14 * std::abs(offset);
    ASSERT_NEAR(a.lower, b.lower, tolerance);
    ASSERT_NEAR(a.upper, b.upper, tolerance);
}

TEST(QuadraticBin, FlippingThePlaneFlipsTheRange) {
    Random random(69);
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const QuadraticBin bin = quadratic(c.oracle.ellipsoid(), c.oracle.bin());
        const Interval range = bin.distanceRange(c.plane);
        const Interval flipped = bin.distanceRange(c.plane.flipped());
        ASSERT_EQ(flipped.lower, -range.upper);
        ASSERT_EQ(flipped.upper, -range.lower);
    }
}

TEST(QuadraticBin, TurnsWithTheEarth) {
    Random random(70);
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const GeodeticBin& bin = c.oracle.bin();
        const double turn = random.uniform(-kPi, kPi);
        const GeodeticBin turned(bin.latitude(), {bin.longitude().lower + turn, bin.longitude().upper + turn},
                                 bin.altitude());
        if (turned.isFullCircle() || bin.isFullCircle()) continue;  // its middle is fixed
        const glm::dvec3& n = c.plane.normal;
        const Plane plane{
            {n.x * std::cos(turn) - n.y * std::sin(turn), n.x * std::sin(turn) + n.y * std::cos(turn), n.z},
            c.plane.offset};
        expectSameRangeBeyond(quadratic(c.oracle.ellipsoid(), turned).distanceRange(plane),
                              quadratic(c.oracle.ellipsoid(), bin).distanceRange(c.plane), plane.offset);
    }
}

TEST(QuadraticBin, MirrorsWithTheHemispheres) {
    Random random(71);
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const GeodeticBin& bin = c.oracle.bin();
        const GeodeticBin south({-bin.latitude().upper, -bin.latitude().lower}, bin.longitude(), bin.altitude());
        const GeodeticBin west(bin.latitude(), {-bin.longitude().upper, -bin.longitude().lower}, bin.altitude());
        const Interval range = quadratic(c.oracle.ellipsoid(), bin).distanceRange(c.plane);
        const Plane downward{c.plane.normal * glm::dvec3(1.0, 1.0, -1.0), c.plane.offset};
        const Plane westward{c.plane.normal * glm::dvec3(1.0, -1.0, 1.0), c.plane.offset};
        expectSameRangeBeyond(quadratic(c.oracle.ellipsoid(), south).distanceRange(downward), range, c.plane.offset);
        expectSameRangeBeyond(quadratic(c.oracle.ellipsoid(), west).distanceRange(westward), range, c.plane.offset);
    }
}

TEST(QuadraticBin, SmallerBoxesHaveSmallerRanges) {
    // Not exactly: the model of a quarter is another model. But never beyond both remainders.
    Random random(72);
    for (int trial = 0; trial < 20000; ++trial) {
        const GeodeticBin parent = randomTile(random, random.integer(0, 10), {-500.0, 9000.0});
        const Plane plane{random.direction(), 0.0};
        const Interval outer = quadratic(wgs84(), parent).distanceRange(plane);
        for (const GeodeticBin& child : parent.quarters()) {
            const QuadraticBin model = quadratic(wgs84(), child);
            const Interval inner = model.distanceRange(plane);
            const double allowance = 2.0 * model.remainder() + kSameGeometry;
            ASSERT_GE(inner.lower, outer.lower - allowance);
            ASSERT_LE(inner.upper, outer.upper + allowance);
        }
    }
}

TEST(QuadraticBin, CameraInsideTheBinKeepsIt) {
    Random random(73);
    for (int trial = 0; trial < 50000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomBin(random);
        const glm::dvec3 eye = rounded(geodeticToEcef(ellipsoid, randomPosition(random, bin)));
        const glm::dvec3 normal = random.direction();
        const Side side = quadratic(ellipsoid, bin).classify({normal, -glm::dot(normal, eye)});
        ASSERT_EQ(side, Side::Straddling);
    }
}

TEST(QuadraticBin, APointHasNoRange) {
    Random random(74);
    for (int trial = 0; trial < 10000; ++trial) {
        const GeodeticBin bin = randomBin(random, BinKind::Point);
        const Plane plane{random.direction(), 0.0};
        const Interval range = quadratic(wgs84(), bin).distanceRange(plane);
        ASSERT_LE(range.width(), 1e-5);
        const Real at = exactDistance(plane, geodeticToEcef(wgs84(), bin.center()));
        ASSERT_NEAR(range.middle(), static_cast<double>(at), kSameGeometry);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test

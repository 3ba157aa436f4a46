// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the definition of the set, point by point; set algebra on random bins (RapidCheck shrinks its
// counter-examples). What a bin looks like in space is tested with the mapping.

#include "CoreTest.h"

#include <rapidcheck/gtest.h>

namespace osgAnalyticBin::test {
namespace {

constexpr double kTwoPi = 2.0 * kPi;
constexpr double kAngleTolerance = 2e-15;  // promised by GeodeticBin::contains
constexpr Interval kGround{0.0, 100.0};

// Bins on a grid of ten degrees shrink to readable counter-examples.
rc::Gen<GeodeticBin> anyGridBin() {
    using rc::gen::inRange;
    return rc::gen::apply(
        [](int south, int height, int west, int width, int low) {
            return GeodeticBin::fromDegrees({-90.0 + south * 10.0, -90.0 + std::min(south + height, 18) * 10.0},
                                            {-180.0 + west * 10.0, -180.0 + (west + width) * 10.0},
                                            {low * 1.0, low + 2.0});
        },
        inRange(0, 19), inRange(0, 19), inRange(-36, 36), inRange(0, 37), inRange(0, 5));
}

TEST(GeodeticBin, IsEmptyByDefault) {
    const GeodeticBin bin;
    EXPECT_TRUE(bin.empty());
    EXPECT_FALSE(bin.contains(Geodetic{}));
    EXPECT_TRUE(bin.contains(GeodeticBin{}));
    EXPECT_TRUE(bin == GeodeticBin{});
}

TEST(GeodeticBin, ImproperIntervalsMakeItEmpty) {
    const Interval fine{0.0, 1.0};
    for (const Interval& bad : {Interval{1.0, 0.0}, Interval{kNaN, 1.0}, Interval{0.0, kNaN}, Interval{kNaN, kNaN},
                                Interval{-kInfinity, 1.0}, Interval{0.0, kInfinity}}) {
        EXPECT_TRUE(GeodeticBin(bad, fine, fine).empty());
        EXPECT_TRUE(GeodeticBin(fine, bad, fine).empty());
        EXPECT_TRUE(GeodeticBin(fine, fine, bad).empty());
        EXPECT_TRUE(GeodeticBin(fine, fine, fine).withAltitude(bad).empty());
        EXPECT_TRUE(GeodeticBin::wholeGlobe(bad).empty());
    }
}

TEST(GeodeticBin, ZeroSizeIsNotEmpty) {
    const GeodeticBin bin({0.5, 0.5}, {1.0, 1.0}, {3.0, 3.0});
    EXPECT_FALSE(bin.empty());
    EXPECT_TRUE(bin.contains(Geodetic{0.5, 1.0, 3.0}));
    EXPECT_FALSE(bin.contains(Geodetic{std::nextafter(0.5, 1.0), 1.0, 3.0}));
    EXPECT_FALSE(bin.contains(Geodetic{0.5, 1.0 + 1e-14, 3.0}));
    EXPECT_FALSE(bin.contains(Geodetic{0.5, 1.0, std::nextafter(3.0, 4.0)}));
}

TEST(GeodeticBin, FullCircleHoldsEveryLongitude) {
    for (const GeodeticBin& bin :
         {GeodeticBin::wholeGlobe(kGround), GeodeticBin::fromDegrees({-90.0, 90.0}, {-180.0, 180.0}, kGround),
          GeodeticBin::fromDegrees({-90.0, 90.0}, {0.0, 360.0}, kGround),
          GeodeticBin::fromDegrees({-90.0, 90.0}, {17.0, 500.0}, kGround)}) {
        EXPECT_TRUE(bin.isFullCircle());
        EXPECT_EQ(bin.longitude().width(), kTwoPi);
        for (const double longitude : {0.0, kPi, -kPi, 3.0, -3.0, 7.0, 100.0}) {
            EXPECT_TRUE(bin.contains(Geodetic{kHalfPi, longitude, 1.0})) << longitude;
            EXPECT_TRUE(bin.contains(Geodetic{-kHalfPi, longitude, 1.0})) << longitude;
        }
        EXPECT_TRUE(bin.contains(GeodeticBin::wholeGlobe(kGround)));
    }
    EXPECT_FALSE(GeodeticBin({0.0, 1.0}, {0.0, 6.28}, kGround).isFullCircle());
}

TEST(GeodeticBin, EndsAtThePoles) {
    const GeodeticBin bin = GeodeticBin::fromDegrees({-90.0, 90.0}, {-180.0, 180.0}, kGround);
    EXPECT_EQ(bin.latitude(), (Interval{-kHalfPi, kHalfPi}));
    EXPECT_EQ(bin.longitude(), (Interval{-kPi, kPi}));
    EXPECT_EQ(GeodeticBin({-2.0, 2.0}, {0.0, 1.0}, kGround).latitude(), (Interval{-kHalfPi, kHalfPi}));
}

TEST(GeodeticBin, DegreesThatShareAnEdgeShareItInRadians) {
    Random random(30);
    for (int trial = 0; trial < 10000; ++trial) {
        const double edge = random.uniform(-90.0, 90.0);
        const GeodeticBin a = GeodeticBin::fromDegrees({-90.0, edge}, {-100.0, edge}, kGround);
        const GeodeticBin b = GeodeticBin::fromDegrees({edge, 90.0}, {edge, 100.0}, kGround);
        ASSERT_EQ(a.latitude().upper, b.latitude().lower);
        ASSERT_EQ(a.longitude().upper, b.longitude().lower);
        const GeodeticBin c = GeodeticBin::fromDegrees({std::nextafter(edge, 91.0), 90.0}, {edge, 100.0}, kGround);
        ASSERT_LE(b.latitude().lower, c.latitude().lower) << "the conversion is monotone";
    }
}

// The edges, turned: what they lose is made up for by the tolerance alone.
TEST(GeodeticBin, HoldsItsEdgesAfterATurn) {
    Random random(33);
    for (int trial = 0; trial < 100000; ++trial) {
        const double west = random.uniform(-kPi, kPi);
        const GeodeticBin bin({0.0, 1.0}, {west, west + random.logUniform(1e-6, 3.0)}, kGround);
        for (const double edge : {bin.longitude().lower, bin.longitude().upper}) {
            for (const double turn : {-kTwoPi, kTwoPi}) {
                const double turned = edge + turn;
                if (std::abs(turned) > 7.0) continue;
                ASSERT_TRUE(bin.contains(Geodetic{0.5, turned, 1.0})) << trial;
                const GeodeticBin narrow({0.0, 1.0}, {turned, turned}, kGround);
                ASSERT_TRUE(bin.contains(narrow)) << trial;
            }
        }
        const double shift = random.sign() * kTwoPi;
        const GeodeticBin turned({0.0, 1.0}, {bin.longitude().lower + shift, bin.longitude().upper + shift}, kGround);
        ASSERT_TRUE(turned.longitude().width() > bin.longitude().width() || bin.contains(turned)) << trial;
    }
}

// The angle in [-pi, pi], without the rounding of 2 pi to a long double.
Real withoutTurns(double longitude) {
    constexpr Real kTurn = 6.28318530717958647692528676655900577L;
    constexpr Real kTooMuch = 1.0033115225336664047e-19L;  // by which that constant exceeds 2 pi
    const Real rest = std::remainder(static_cast<Real>(longitude), kTurn);
    return rest + std::nearbyint((static_cast<Real>(longitude) - rest) / kTurn) * kTooMuch;
}

TEST(GeodeticBin, UnionHoldsBinsManyTurnsAway) {
    constexpr Real kTurn = 6.28318530717958647692528676655900577L;
    constexpr Real kOracleRounding = 1e-17L;
    Random random(34);
    for (int trial = 0; trial < 100000; ++trial) {
        const double far = random.sign() * random.logUniform(1.0, 1e6), near = random.uniform(-10.0, 10.0);
        const GeodeticBin away({0.0, 1.0}, {far, far + random.logUniform(1e-9, 1.0)}, kGround);
        const GeodeticBin here({0.0, 1.0}, {near, near + random.logUniform(1e-9, 1.0)}, kGround);
        for (const GeodeticBin& both : {away.united(here), here.united(away)}) {
            ASSERT_TRUE(both.contains(away)) << far;
            ASSERT_TRUE(both.contains(here)) << far;
            if (both.isFullCircle()) continue;
            const Real west = withoutTurns(both.longitude().lower);
            const Real width = static_cast<Real>(both.longitude().upper) - both.longitude().lower;
            for (const double edge : {far, away.longitude().upper, near, here.longitude().upper}) {
                Real offset = withoutTurns(edge) - west;
                while (offset < -kOracleRounding) offset += kTurn;
                while (offset > kTurn - kOracleRounding) offset -= kTurn;
                ASSERT_LE(offset, width + kOracleRounding) << far << " " << edge;
            }
        }
    }
}

TEST(GeodeticBin, LongitudesThatAreTooFarAwayAreAll) {
    constexpr double kLimit = 1e6;
    const auto at = [](double west) { return GeodeticBin({0.0, 1.0}, {west, west + 0.1}, kGround); };
    for (const double side : {1.0, -1.0}) {
        EXPECT_FALSE(at(side * (kLimit - 1.0)).isFullCircle());
        EXPECT_TRUE(at(side * (kLimit + 1.0)).isFullCircle());
        EXPECT_EQ(at(side * 1e300).longitude(), (Interval{-kPi, kPi}));
        EXPECT_TRUE(at(side * 1e8).contains(Geodetic{0.5, 0.0, 1.0}));
        EXPECT_TRUE(at(side * 1e8).contains(Geodetic{0.5, side * 1e8, 1.0}));
    }
}

TEST(GeodeticBin, HoldsPositionsInItAndRejectsThoseBesideIt) {
    Random random(32);
    for (int trial = 0; trial < 100000; ++trial) {
        const GeodeticBin bin = randomBin(random);
        const Geodetic inside = randomPosition(random, bin);
        const double step = random.logUniform(1e-14, 0.1);
        const auto holds = [&](double Geodetic::*place, double at) {
            Geodetic position = inside;
            position.*place = at;
            return bin.contains(position);
        };
        for (const double turn : {-kTwoPi, 0.0, kTwoPi})
            ASSERT_TRUE(std::abs(inside.longitude + turn) > 7.0 ||
                        holds(&Geodetic::longitude, inside.longitude + turn));
        ASSERT_FALSE(holds(&Geodetic::latitude, bin.latitude().upper + step));
        ASSERT_FALSE(holds(&Geodetic::latitude, bin.latitude().lower - step));
        ASSERT_FALSE(holds(&Geodetic::altitude, bin.altitude().upper + 1e6 * step));
        if (bin.longitude().width() + step >= kTwoPi - 1e-14) continue;
        ASSERT_FALSE(holds(&Geodetic::longitude, bin.longitude().upper + step));
        ASSERT_FALSE(holds(&Geodetic::longitude, bin.longitude().lower - step));
    }
}

TEST(GeodeticBin, NothingHoldsAPositionWithoutNumbers) {
    const GeodeticBin globe = GeodeticBin::wholeGlobe(kGround);
    EXPECT_FALSE(globe.contains(Geodetic{kNaN, 0.0, 1.0}));
    EXPECT_FALSE(globe.contains(Geodetic{0.0, kNaN, 1.0}));
    EXPECT_FALSE(globe.contains(Geodetic{0.0, 0.0, kNaN}));
    EXPECT_FALSE(globe.contains(Geodetic{0.0, kInfinity, 1.0}));
    GeodeticBin bin({0.0, 1.0}, {0.0, 1.0}, kGround);
    const GeodeticBin before = bin;
    bin.expandBy(Geodetic{kNaN, 0.0, 0.0});
    EXPECT_TRUE(bin == before);
}

RC_GTEST_PROP(GeodeticBin, UnionIsTheSmallestOfTheTwoWaysRound, ()) {
    const GeodeticBin a = *anyGridBin();
    const GeodeticBin b = *anyGridBin();
    const GeodeticBin both = a.united(b);
    RC_ASSERT(both.contains(a) && both.contains(b));
    RC_ASSERT(a.united(GeodeticBin{}) == a && GeodeticBin{}.united(a) == a);
    // The brute-force width: the circle less the widest gap, found on the grid's cells.
    int covered[36] = {};
    for (const GeodeticBin& bin : {a, b}) {
        const int west = static_cast<int>(std::lround(bin.longitude().lower / kRadiansPerDegree / 10.0)) + 72;
        const int width = static_cast<int>(std::lround(bin.longitude().width() / kRadiansPerDegree / 10.0));
        for (int i = 0; i < width; ++i) covered[(west + i) % 36] = 1;
    }
    RC_PRE(a.longitude().width() > 0.01 && b.longitude().width() > 0.01);
    int widestGap = 0;
    for (int start = 0; start < 36; ++start) {
        int gap = 0;
        while (gap < 36 && covered[(start + gap) % 36] == 0) ++gap;
        widestGap = std::max(widestGap, gap);
    }
    const double smallest = (36 - widestGap) * 10.0 * kRadiansPerDegree;
    RC_ASSERT(std::abs(both.longitude().width() - smallest) < 1e-12);
    RC_ASSERT(both.latitude().lower == std::min(a.latitude().lower, b.latitude().lower));
    RC_ASSERT(both.latitude().upper == std::max(a.latitude().upper, b.latitude().upper));
    RC_ASSERT(both.altitude().lower == std::min(a.altitude().lower, b.altitude().lower));
    RC_ASSERT(both.altitude().upper == std::max(a.altitude().upper, b.altitude().upper));
}

TEST(GeodeticBin, QuartersNestExactly) {
    Random random(34);
    for (int trial = 0; trial < 20000; ++trial) {
        GeodeticBin bin = randomBin(random);
        for (int depth = 0; depth < 4; ++depth) {
            const auto [southWest, southEast, northWest, northEast] = bin.quarters();
            ASSERT_EQ(southWest.latitude().lower, bin.latitude().lower);
            ASSERT_EQ(southWest.longitude().lower, bin.longitude().lower);
            ASSERT_EQ(northEast.latitude().upper, bin.latitude().upper);
            ASSERT_EQ(northEast.longitude().upper, bin.longitude().upper);
            ASSERT_EQ(southWest.latitude(), southEast.latitude());
            ASSERT_EQ(northWest.latitude(), northEast.latitude());
            ASSERT_EQ(southWest.longitude(), northWest.longitude());
            ASSERT_EQ(southEast.longitude(), northEast.longitude());
            ASSERT_EQ(southWest.latitude().upper, northWest.latitude().lower);
            ASSERT_EQ(southWest.longitude().upper, southEast.longitude().lower);
            for (const GeodeticBin& quarter : bin.quarters()) {
                ASSERT_FALSE(quarter.empty());
                ASSERT_TRUE(bin.contains(quarter));
                ASSERT_EQ(quarter.altitude(), bin.altitude());
            }
            bin = bin.quarters()[static_cast<std::size_t>(random.integer(0, 3))];
        }
    }
}

TEST(GeodeticBin, ManySmallExpansionsDoNotDrift) {
    Random random(35);
    const GeodeticBin whole = GeodeticBin::fromDegrees({-10.0, 10.0}, {170.0, 195.0}, kGround);
    GeodeticBin grown;
    for (int trial = 0; trial < 10000; ++trial) {
        Geodetic position = randomPosition(random, whole);
        if (position.longitude > kPi) position.longitude -= kTwoPi;
        grown.expandBy(position);
        ASSERT_TRUE(grown.contains(position));
    }
    EXPECT_LE(grown.longitude().width(), whole.longitude().width() + 4.0 * kAngleTolerance);
    EXPECT_GE(grown.longitude().width(), whole.longitude().width() - 4.0 * kAngleTolerance);
}

}  // namespace
}  // namespace osgAnalyticBin::test

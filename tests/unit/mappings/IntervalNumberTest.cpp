// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: long double evaluation at points of the interval, ends and extrema among them.

#include <osgAnalyticBin/mappings/IntervalNumber.h>

#include <gtest/gtest.h>

#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::IntervalNumber;

bool holds(const IntervalNumber& x, Real value) {
    return x.lower() <= value && value <= x.upper();
}

bool isUndefinedOrHolds(const IntervalNumber& x, Real value) {
    return !x.isDefined() || holds(x, value);
}

IntervalNumber randomInterval(Random& random, double limit) {
    const double middle = random.sign() * random.logUniform(1e-6, limit);
    const double reach = random.chance(0.2) ? 0.0 : random.logUniform(1e-12, 4.0);
    return {middle - reach, middle + reach};
}

Real randomPoint(Random& random, const IntervalNumber& x) {
    if (random.chance(0.2)) return x.lower();
    if (random.chance(0.2)) return x.upper();
    const Real t = random.uniform();
    return std::min<Real>(std::max<Real>(x.lower() + t * (static_cast<Real>(x.upper()) - x.lower()), x.lower()),
                          x.upper());
}

TEST(IntervalNumber, ArithmeticHoldsEveryResult) {
    Random random(300);
    for (int trial = 0; trial < 200000; ++trial) {
        const IntervalNumber a = randomInterval(random, 1e7), b = randomInterval(random, 10.0);
        const Real x = randomPoint(random, a), y = randomPoint(random, b);
        ASSERT_TRUE(holds(a + b, x + y));
        ASSERT_TRUE(holds(a - b, x - y));
        ASSERT_TRUE(holds(a * b, x * y));
        ASSERT_TRUE(holds(-a, -x));
        const IntervalNumber quotient = a / b;
        ASSERT_TRUE(quotient.isDefined() ? holds(quotient, x / y) : holds(b, 0));
    }
}

TEST(IntervalNumber, FunctionsHoldEveryResult) {
    Random random(301);
    for (int trial = 0; trial < 200000; ++trial) {
        const IntervalNumber a = randomInterval(random, random.chance(0.1) ? 1e7 : 20.0);
        const Real x = randomPoint(random, a);
        ASSERT_TRUE(holds(sin(a), std::sin(x)));
        ASSERT_TRUE(holds(cos(a), std::cos(x)));
        ASSERT_TRUE(holds(atan(a), std::atan(x)));
        ASSERT_TRUE(isUndefinedOrHolds(tan(a), std::tan(x)));
        ASSERT_TRUE(isUndefinedOrHolds(exp(a), std::exp(x)));
        ASSERT_TRUE(isUndefinedOrHolds(sqrt(a), std::sqrt(x)));
        ASSERT_TRUE(isUndefinedOrHolds(log(a), std::log(x)));
        const int n = random.integer(-4, 6);
        ASSERT_TRUE(isUndefinedOrHolds(pow(a, n), std::pow(x, static_cast<Real>(n))));
    }
}

TEST(IntervalNumber, WavesKnowTheirExtrema) {
    for (int k = -40; k <= 40; ++k) {
        const double top = (0.5 + 2.0 * k) * kPi;
        EXPECT_EQ(sin(IntervalNumber(top - 0.1, top + 0.1)).upper(), 1.0);
        EXPECT_EQ(sin(IntervalNumber(top + kPi - 0.1, top + kPi + 0.1)).lower(), -1.0);
        EXPECT_EQ(cos(IntervalNumber(2.0 * k * kPi - 0.1, 2.0 * k * kPi + 0.1)).upper(), 1.0);
        EXPECT_LT(sin(IntervalNumber(top + 0.1, top + 0.2)).upper(), 0.9951);
        EXPECT_GT(cos(IntervalNumber(top + 0.1, top + 0.2)).lower(), -0.1987);
    }
    EXPECT_EQ(sin(IntervalNumber(-1e300, 1e300)).lower(), -1.0);
}

TEST(IntervalNumber, IsTightOnPoints) {
    constexpr double kUlps = 12.0 * std::numeric_limits<double>::epsilon();
    Random random(302);
    for (int trial = 0; trial < 10000; ++trial) {
        const IntervalNumber x(random.uniform(0.5, 1.0));
        for (const IntervalNumber& y : {sin(x), cos(x), tan(x), atan(x), exp(x), sqrt(x), x * x, x / x, x + x})
            ASSERT_LE(y.upper() - y.lower(), kUlps * y.magnitude());
    }
    EXPECT_EQ(pow(IntervalNumber(-1.0, 2.0), 2).lower(), 0.0);
}

TEST(IntervalNumber, WhatHasNoBoundsIsUndefinedAndStaysSo) {
    const IntervalNumber none = IntervalNumber::undefined();
    EXPECT_FALSE(none.isDefined());
    EXPECT_FALSE((1.0 / IntervalNumber(-1.0, 1.0)).isDefined());
    EXPECT_FALSE((1.0 / IntervalNumber(0.0)).isDefined());
    EXPECT_FALSE(log(IntervalNumber(0.0, 1.0)).isDefined());
    EXPECT_FALSE(sqrt(IntervalNumber(-1.0, 1.0)).isDefined());
    EXPECT_FALSE(tan(IntervalNumber(1.5, 1.6)).isDefined());
    EXPECT_FALSE(exp(IntervalNumber(1000.0)).isDefined());
    EXPECT_FALSE(pow(IntervalNumber(-1.0, 1.0), -1).isDefined());
    EXPECT_FALSE((IntervalNumber(1e300) * IntervalNumber(1e300)).isDefined());
    EXPECT_FALSE(IntervalNumber(kInfinity).isDefined());
    EXPECT_FALSE(IntervalNumber(std::nan("")).isDefined());
    EXPECT_FALSE(IntervalNumber(1.0, 0.0).isDefined());
    for (const IntervalNumber& x : {none + 1.0, none * 0.0, none - none, 1.0 / none, -none, sqrt(none), exp(none),
                                    log(none), sin(none), cos(none), tan(none), atan(none), pow(none, 2)})
        EXPECT_FALSE(x.isDefined());
}

}  // namespace
}  // namespace osgAnalyticBin::test

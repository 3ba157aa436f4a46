// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: GeodeticMapping's closed forms, finite differences and dense sampling in long double, convergence order.

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <support/MappingChecks.h>
#include <support/RandomBins.h>
#include <type_traits>

namespace osgAnalyticBin::test {
namespace {

using core::AutodiffMapping;
using core::ParameterBox;
using core::QuadraticBin;
using core::TaylorInterval;
using core::Vec3;

// Geodetic to ECEF; a sphere for e2 = 0.
struct GeodeticFormula {
    double a;
    double e2;

    template <class T>
    Vec3<T> operator()(T latitude, T longitude, T altitude) const {
        using std::cos;
        using std::sin;
        using std::sqrt;
        const T s = sin(latitude);
        const T n = a / sqrt(1.0 - e2 * (s * s));
        const T radius = (n + altitude) * cos(latitude);
        return {radius * cos(longitude), radius * sin(longitude), (n * (1.0 - e2) + altitude) * s};
    }
};

// Every function there is an enclosure for.
struct AllFunctions {
    template <class T>
    Vec3<T> operator()(T u, T v, T w) const {
        using std::atan;
        using std::cos;
        using std::exp;
        using std::log;
        using std::pow;
        using std::sin;
        using std::sqrt;
        using std::tan;
        return {sin(u + v) * exp(w * 0.5) + pow(u, 3) - 2.0 / (v + 3.0), sqrt(u + 2.0) * tan(v * 0.5) + atan(u * w),
                log(w + 4.0) * cos(u - w) + pow(v + 2.0, -2) - u / (w + 3.0)};
    }
};

// A user's bound, taken at its word.
struct SuppliedBound {
    template <class T>
    Vec3<T> operator()(T u, T v, T w) const {
        using std::asin;  // has no enclosure
        return {asin(u), v, w};
    }
    double remainder(const ParameterBox& box) const {
        const double x = std::abs(box.center.x) + box.halfSize.x;
        return (1.0 + 2.0 * x * x) / std::pow(1.0 - x * x, 2.5) * std::pow(box.halfSize.x, 3.0) / 6.0;
    }
};

struct Cancelling {
    template <class T>
    Vec3<T> operator()(T u, T v, T w) const {
        return {(u + 1e9) - 1e9, v, w};
    }
};

struct Pole {
    template <class T>
    Vec3<T> operator()(T u, T v, T w) const {
        return {1.0 / u, v, w};
    }
};

// What must not compile: functions without an enclosure, and comparisons.
template <class Call>
constexpr bool takesTaylor(const Call&) {
    return std::is_invocable_v<Call, TaylorInterval>;
}

static_assert(takesTaylor([](auto t) -> decltype(void(pow(t, 2))) {}));
static_assert(!takesTaylor([](auto t) -> decltype(void(pow(t, 0.5))) {}));
static_assert(!takesTaylor([](auto t) -> decltype(void(asin(t))) {}));
static_assert(!takesTaylor([](auto t) -> decltype(void(std::abs(t))) {}));
static_assert(!takesTaylor([](auto t) -> decltype(void(t < t)) {}));
static_assert(!std::is_convertible_v<TaylorInterval, double>);
static_assert(core::HasRemainder<SuppliedBound>::value);
static_assert(!core::HasRemainder<Pole>::value);

ParameterBox randomBox(Random& random, double largest) {
    const auto reach = [&] { return random.logUniform(1e-4, largest); };
    return {{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)},
            {reach(), reach(), reach()}};
}

TEST(AutodiffMapping, EqualsTheGeodeticMapping) {
    Random random(310);
    for (int trial = 0; trial < 500; ++trial) {
        const core::Ellipsoid ellipsoid = trial % 4 == 0 ? core::Ellipsoid(6.4e6, 6.4e6) : wgs84();
        const core::GeodeticMapping closed(ellipsoid);
        const AutodiffMapping<GeodeticFormula> autodiff(
            {ellipsoid.equatorialRadius(), ellipsoid.eccentricitySquared()});
        const glm::dvec3 at(random.uniform(-kHalfPi, kHalfPi), random.uniform(-kPi, kPi), random.uniform(-1e4, 4e5));
        constexpr double kTolerance = 5e-8;  // metres, per radian and per radian squared: 40 eps
        EXPECT_LE(glm::distance(closed.value(at), autodiff.value(at)), kTolerance);
        for (glm::length_t i = 0; i < 3; ++i)
            EXPECT_LE(glm::distance(closed.jacobian(at)[i], autodiff.jacobian(at)[i]), kTolerance);
        const core::Hessians a = closed.hessians(at), b = autodiff.hessians(at);
        for (const glm::dvec3& difference :
             {a.uu - b.uu, a.vv - b.vv, a.ww - b.ww, a.uv - b.uv, a.uw - b.uw, a.vw - b.vw})
            EXPECT_LE(glm::length(difference), kTolerance);
    }
}

// Against the bound by hand: how much the interval arithmetic costs.
TEST(AutodiffMapping, EnclosedBoundIsSoundAndTightOnTiles) {
    Random random(311);
    const core::GeodeticMapping closed(wgs84());
    const AutodiffMapping<GeodeticFormula> autodiff({wgs84().equatorialRadius(), wgs84().eccentricitySquared()});
    for (int level = 1; level <= 3; ++level) {
        double worst = 0.0;
        for (int trial = 0; trial < 30; ++trial) {
            const ParameterBox box = core::parameterBox(randomTile(random, level, kTerrainAltitudes));
            worst = std::max(worst, expectRemainderHolds(autodiff, box));
        }
        std::printf("level %d: remainder at most %.2f times the model's error\n", level, worst);
        EXPECT_LE(worst, 1.7);
    }
}

TEST(AutodiffMapping, IsSoundForAllFunctions) {
    Random random(312);
    for (int trial = 0; trial < 100; ++trial) {
        const AutodiffMapping<AllFunctions> mapping({}), inPieces({}, random.integer(1, 3));
        expectDerivativesMatchDifferences(mapping, randomBox(random, 0.25), random);
        expectRemainderHolds(inPieces, randomBox(random, 0.4));
        expectNoContradiction(mapping, randomBox(random, 0.4), random);
    }
}

TEST(AutodiffMapping, ErrorFallsEightfoldPerHalving) {
    expectErrorFallsEightfold(AutodiffMapping<AllFunctions>({}), {{0.3, 0.2, 0.1}, {0.1, 0.1, 0.1}}, 4);
}

TEST(AutodiffMapping, MorePiecesAreTighter) {
    const ParameterBox box{{0.3, 0.2, 0.1}, {0.4, 0.4, 0.4}};
    double last = HUGE_VAL;
    for (const int pieces : {1, 2, 4}) {
        const double remainder = AutodiffMapping<AllFunctions>({}, pieces).remainder(box);
        EXPECT_LT(remainder, last) << pieces;
        last = remainder;
    }
}

TEST(AutodiffMapping, TakesTheBoundThatTheFormulaBrings) {
    const AutodiffMapping<SuppliedBound> mapping({});
    const ParameterBox box{{0.2, 0.0, 0.0}, {0.3, 1.0, 1.0}};
    EXPECT_EQ(mapping.remainder(box), SuppliedBound().remainder(box));
    expectRemainderHolds(mapping, box);
}

TEST(AutodiffMapping, CountsTheRoundingOfTheFormula) {
    // (u + 1e9) - 1e9 loses half of its digits: the model is off by 1e-7, and the bound knows.
    const ParameterBox box{{1.0 / 3.0, 0.0, 0.0}, {1e-3, 1e-3, 1e-3}};
    const QuadraticBin bin(AutodiffMapping<Cancelling>({}), box);
    const double off = std::abs(bin.modelPoint({0.0, 0.0, 0.0}).x - 1.0 / 3.0);
    EXPECT_GT(off, 1e-9);
    EXPECT_LE(off, bin.remainder());
    EXPECT_LE(bin.remainder(), 1e-5);
}

TEST(AutodiffMapping, APoleInTheBoxMakesEveryPlaneStraddle) {
    const QuadraticBin bin(AutodiffMapping<Pole>({}), {{0.5, 0.0, 0.0}, {0.6, 1.0, 1.0}});
    EXPECT_TRUE(std::isinf(bin.remainder()));
    EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, -1e12}), core::Side::Straddling);
    EXPECT_EQ(bin.classify({{0.0, 1.0, 0.0}, 1e12}), core::Side::Straddling);
}

}  // namespace
}  // namespace osgAnalyticBin::test

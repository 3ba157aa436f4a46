// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: GeodeticMapping's closed forms, finite differences and dense sampling in long double, convergence order.

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>

#include <gtest/gtest.h>

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

/// The formula over a box, in long double; positions are of the unit box [-1, 1]^3.
template <class F>
class FormulaOracle final {
public:
    FormulaOracle(const F& formula, const core::ParameterBox& box) : _formula(formula), _box(box) {}

    [[nodiscard]] RealVector operator()(Real u, Real v, Real w) const {
        const core::Vec3<Real> f = _formula(_box.center.x + u * _box.halfSize.x, _box.center.y + v * _box.halfSize.y,
                                            _box.center.z + w * _box.halfSize.z);
        return {f.x, f.y, f.z};
    }
    [[nodiscard]] RealVector operator()(const std::array<Real, 3>& at) const { return (*this)(at[0], at[1], at[2]); }

    /// steps + 1 positions along each side, both ends among them.
    [[nodiscard]] std::vector<std::array<Real, 3>> grid(int steps) const {
        std::vector<std::array<Real, 3>> positions;
        const auto at = [&](int i) { return static_cast<Real>(2 * i) / steps - 1; };
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; j <= steps; ++j) {
                for (int k = 0; k <= steps; ++k) positions.push_back({at(i), at(j), at(k)});
            }
        }
        return positions;
    }

    /// The largest |f - model| over a grid.
    [[nodiscard]] double modelError(const core::QuadraticBin& bin, int steps) const {
        Real worst = 0;
        for (const auto& p : grid(steps)) {
            const glm::dvec3 unit(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
            // steps is a power of two: unit is p
            worst = std::max(worst, length((*this)(p)-real(bin.modelPoint(unit))));
        }
        return static_cast<double>(worst);
    }

    /// The largest n.f that sampling and climbing find: never above the true one.
    [[nodiscard]] Real support(const RealVector& n, int steps) const {
        std::array<Real, 3> best{};
        Real value = dot(n, (*this)(best));
        const auto improve = [&](const std::array<Real, 3>& p) {
            const Real candidate = dot(n, (*this)(p));
            if (!(candidate > value)) return false;
            value = candidate;
            best = p;
            return true;
        };
        for (const auto& p : grid(steps)) improve(p);
        for (Real reach = Real(1) / steps; reach > 1e-9L; reach *= Real(0.5)) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const Real step : {-reach, reach}) {
                    std::array<Real, 3> p = best;
                    p[axis] = std::min(std::max(p[axis] + step, Real(-1)), Real(1));
                    improve(p);
                }
            }
        }
        return value;
    }

private:
    const F& _formula;
    core::ParameterBox _box;
};

/// Jacobian and Hessians are the derivatives of the formula, all along random steps of up to a half size.
template <class F>
void expectDerivativesMatchDifferences(const core::AutodiffMapping<F>& mapping, const core::ParameterBox& box,
                                       Random& random) {
    constexpr Real kStep = 1e-3L;
    // Relative to the sum of the model's coefficients: t^4 / 30 of the fifth derivative, and rounding over t squared.
    constexpr double kTolerance = 1e-9;
    const FormulaOracle<F> f(mapping.formula(), box);
    const core::Hessians h = mapping.hessians(box.center);
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    for (int trial = 0; trial < 20; ++trial) {
        const glm::dvec3 s = trial < 3 ? glm::dvec3(trial == 0, trial == 1, trial == 2) : random.direction();
        const glm::dvec3 e = s * box.halfSize;
        const auto at = [&](Real t) { return f(s.x * t, s.y * t, s.z * t); };
        const RealVector middle = at(0);
        const RealVector first = (1 / (12 * kStep)) * (8 * (at(kStep) - at(-kStep)) - (at(2 * kStep) - at(-2 * kStep)));
        const RealVector second = (1 / (12 * kStep * kStep)) * (16 * (at(kStep) + at(-kStep) - 2 * middle) -
                                                                (at(2 * kStep) + at(-2 * kStep) - 2 * middle));
        const glm::dvec3 firstComputed = jacobian * e;
        const glm::dvec3 secondComputed = h.uu * (e.x * e.x) + h.vv * (e.y * e.y) + h.ww * (e.z * e.z) +
                                          2.0 * (h.uv * (e.x * e.y) + h.uw * (e.x * e.z) + h.vw * (e.y * e.z));
        const double size =
            glm::length(mapping.value(box.center)) + glm::length(firstComputed) + glm::length(secondComputed);
        ASSERT_LE(static_cast<double>(length(real(mapping.value(box.center)) - middle)), 1e-14 * size);
        ASSERT_LE(static_cast<double>(length(real(firstComputed) - first)), kTolerance * size);
        ASSERT_LE(static_cast<double>(length(real(secondComputed) - second)), kTolerance * size);
    }
}

/// The remainder holds the model's error. Returns: their ratio.
template <class F>
double expectRemainderHolds(const core::AutodiffMapping<F>& mapping, const core::ParameterBox& box) {
    const core::QuadraticBin bin(mapping, box);
    const double error = FormulaOracle<F>(mapping.formula(), box).modelError(bin, 16);
    EXPECT_LE(error, bin.remainder());
    return bin.remainder() / error;
}

/// No plane, near a tangent or random, has a verdict that a point of the box contradicts.
template <class F>
void expectNoContradiction(const core::AutodiffMapping<F>& mapping, const core::ParameterBox& box, Random& random) {
    const core::QuadraticBin bin(mapping, box);
    const FormulaOracle<F> f(mapping.formula(), box);
    const RealVector normal = real(random.direction());
    const Real upper = f.support(normal, 4);
    const Real lower = -f.support(Real(-1) * normal, 4);
    const double size = std::max(static_cast<double>(upper - lower), 1e-6);
    for (int trial = 0; trial < 16; ++trial) {
        const double beside = random.sign() * random.logUniform(1e-10, 1.0) * size;
        const double touched = static_cast<double>(trial % 2 == 0 ? upper : lower);
        const core::Plane plane{rounded(normal), beside - touched};
        const core::Side side = bin.classify(plane);
        const Real most = upper + plane.offset;
        const Real least = lower + plane.offset;
        ASSERT_FALSE(side == core::Side::Outside && most >= 0) << static_cast<double>(most);
        ASSERT_FALSE(side == core::Side::Inside && least < 0) << static_cast<double>(least);
        const core::Interval range = bin.distanceRange(plane);
        ASSERT_LE(range.lower, static_cast<double>(least) + 1e-12 * size);
        ASSERT_GE(range.upper, static_cast<double>(most) - 1e-12 * size);
    }
}

/// How often the model's error falls when the box is halved, from the given box down by `halvings`; 8 in the limit.
template <class F>
void expectErrorFallsEightfold(const core::AutodiffMapping<F>& mapping, core::ParameterBox box, int halvings) {
    double before = 0.0;
    for (int i = 0; i <= halvings; ++i) {
        const core::QuadraticBin bin(mapping, box);
        const double error = FormulaOracle<F>(mapping.formula(), box).modelError(bin, 8);
        if (i > 0) {
            EXPECT_GE(before / error, 6.5) << "halving " << i;
            EXPECT_LE(before / error, 9.5) << "halving " << i;
        }
        before = error;
        box.halfSize *= 0.5;
    }
}

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

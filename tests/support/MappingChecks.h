// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What must hold for any mapping that is made of a formula. Oracles: the formula in long double, its finite
// differences, dense sampling with local refinement, convergence order.

#pragma once

#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <support/GeodeticOracle.h>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::test {

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

}  // namespace osgAnalyticBin::test

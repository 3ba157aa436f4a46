// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/TaylorInterval.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <algorithm>
#include <boost/math/differentiation/autodiff.hpp>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace osgAnalyticBin::core {

/// True for a formula that brings its own bound: `double remainder(const ParameterBox&) const`, with the
/// meaning of AnalyticMapping::remainder().
template <class F, class = void>
struct HasRemainder : std::false_type {};
template <class F>
struct HasRemainder<F, std::void_t<decltype(std::declval<const F&>().remainder(std::declval<const ParameterBox&>()))>>
    : std::true_type {};

/// A mapping from its formula alone. F is copyable and has
///
///     template <class T> Vec3<T> operator()(T u, T v, T w) const
///
/// made of + - * / and of sqrt, exp, log, sin, cos, tan, atan and pow with an integer, called without `std::` after a
/// using declaration. Value and derivatives come from automatic differentiation. The remainder is proven either by F's
/// own remainder(), or else by interval arithmetic over the box; then a formula with any other function does
/// not compile, and a box on which it has a pole or leaves the domain of a root or logarithm has an infinite bound:
/// such a bin straddles every plane.
/// Source: doc/theory/mappings.md, sections 1 - 3.
/// Guarantee: without a bound of F's own, the rounding of value and derivatives is part of the bound, so that
/// QuadraticBin's verdicts hold for the formula in exact arithmetic; tests: AutodiffMapping.*.
/// Cost: the derivatives evaluate F with 27 coefficients a number; the interval bound with 20 intervals, pieces^3
/// times.
template <class F>
class AutodiffMapping final : public AnalyticMapping {
public:
    /// The interval bound is the largest over `pieces` cuts of the box in each parameter: more are tighter and slower.
    explicit AutodiffMapping(F formula, int pieces = 2) noexcept
        : _formula(std::move(formula)), _pieces(std::max(pieces, 1)) {}

    /// The formula that was given.
    [[nodiscard]] const F& formula() const noexcept { return _formula; }

    /// The formula evaluated with double.
    [[nodiscard]] glm::dvec3 value(const glm::dvec3& at) const noexcept override {
        const Vec3<double> f = _formula(at.x, at.y, at.z);
        return {f.x, f.y, f.z};
    }

    /// By automatic differentiation; column i is the derivative by parameter i.
    [[nodiscard]] glm::dmat3 jacobian(const glm::dvec3& at) const noexcept override {
        const auto f = expanded<1>(at);
        return {derivative(f, 1, 0, 0), derivative(f, 0, 1, 0), derivative(f, 0, 0, 1)};
    }

    /// By automatic differentiation.
    [[nodiscard]] Hessians hessians(const glm::dvec3& at) const noexcept override {
        const auto f = expanded<2>(at);
        return {derivative(f, 2, 0, 0), derivative(f, 0, 2, 0), derivative(f, 0, 0, 2),
                derivative(f, 1, 1, 0), derivative(f, 1, 0, 1), derivative(f, 0, 1, 1)};
    }

    [[nodiscard]] double remainder(const ParameterBox& box) const noexcept override {
        if constexpr (HasRemainder<F>::value) {
            return _formula.remainder(box);
        } else {
            return enclosedBound(box);
        }
    }

private:
    // The formula on variables that carry their derivatives up to an order in each of the three.
    template <std::size_t order>
    [[nodiscard]] auto expanded(const glm::dvec3& at) const {
        namespace autodiff = boost::math::differentiation;
        using Number = autodiff::autodiff_fvar<double, order, order, order>;
        const auto variables = autodiff::make_ftuple<double, order, order, order>(at.x, at.y, at.z);
        const Number zero(0.0);
        return _formula(Number(std::get<0>(variables) + zero), Number(std::get<1>(variables) + zero),
                        Number(std::get<2>(variables) + zero));
    }

    template <class Number>
    [[nodiscard]] static glm::dvec3 derivative(const Vec3<Number>& f, std::size_t u, std::size_t v, std::size_t w) {
        return {f.x.derivative(u, v, w), f.y.derivative(u, v, w), f.z.derivative(u, v, w)};
    }

    [[nodiscard]] double enclosedBound(const ParameterBox& box) const noexcept {
        const auto n = static_cast<std::size_t>(_pieces);
        double largest = 0.0;
        for (std::size_t i = 0; i < n * n * n; ++i) {
            const Vec3<IntervalNumber> ranges{piece(box, 0, i % n), piece(box, 1, i / n % n),
                                              piece(box, 2, i / (n * n))};
            largest = std::max(largest, thirdDifferentialBound(enclosed(box.halfSize, ranges)));
        }
        const glm::dvec3& c = box.center;
        const double rounding =
            modelRounding(enclosed(box.halfSize, {c.x, c.y, c.z}), value(c), jacobian(c), hessians(c), box.halfSize);
        return largest / 6.0 + rounding;
    }

    [[nodiscard]] Vec3<TaylorInterval> enclosed(const glm::dvec3& step, const Vec3<IntervalNumber>& ranges) const {
        return _formula(TaylorInterval::variable(0, ranges.x, step.x), TaylorInterval::variable(1, ranges.y, step.y),
                        TaylorInterval::variable(2, ranges.z, step.z));
    }

    // One of the pieces of the box along an axis; neighbours overlap by rounding, none leaves a gap.
    [[nodiscard]] IntervalNumber piece(const ParameterBox& box, glm::length_t axis, std::size_t i) const noexcept {
        const IntervalNumber center(box.center[axis]);
        const IntervalNumber halfSize(box.halfSize[axis]);
        const auto cut = [&](std::size_t k) {
            const double position = 2.0 * static_cast<double>(k) / _pieces - 1.0;
            return center + halfSize * position;
        };
        return {cut(i).lower(), cut(i + 1).upper()};
    }

    F _formula;
    int _pieces;
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/TaylorInterval.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace osgAnalyticBin::core {

/// A mapping from its formula alone. F is copyable and has
///
///     template <class T> Vec3<T> operator()(T u, T v, T w) const
///
/// made of + - * / and of sqrt, exp, log, sin, cos, tan, atan and pow with an integer, called without `std::` after a
/// using declaration. Derivatives come from automatic differentiation, the remainder from interval arithmetic over the
/// box. A formula with any other function does not compile; it needs an AnalyticMapping of its own. A box on which the
/// formula has a pole or leaves the domain of a root or logarithm has an infinite bound: such a bin straddles every
/// plane.
/// Source: doc/theory/mappings.md, sections 1 - 3.
/// Guarantee: the rounding of value and derivatives is part of the bound, so that QuadraticBin's verdicts hold for the
/// formula in exact arithmetic; tests: AutodiffMapping.*.
/// Cost: evaluates F with 20 intervals a number, for each kind of derivative and for each of pieces^3 bounds.
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

    /// Column i is the derivative by parameter i.
    [[nodiscard]] glm::dmat3 jacobian(const glm::dvec3& at) const noexcept override {
        const Vec3<TaylorInterval> f = enclosed(glm::dvec3(1.0), {at.x, at.y, at.z});
        return {middleOf(f, 1), middleOf(f, 2), middleOf(f, 3)};
    }

    [[nodiscard]] Hessians hessians(const glm::dvec3& at) const noexcept override {
        const Vec3<TaylorInterval> f = enclosed(glm::dvec3(1.0), {at.x, at.y, at.z});
        // a square's coefficient is half of its derivative
        return {2.0 * middleOf(f, 4), 2.0 * middleOf(f, 5), 2.0 * middleOf(f, 6),
                middleOf(f, 7),       middleOf(f, 8),       middleOf(f, 9)};
    }

    [[nodiscard]] double remainder(const ParameterBox& box) const noexcept override {
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

private:
    // The middle of what encloses a coefficient.
    [[nodiscard]] static glm::dvec3 middleOf(const Vec3<TaylorInterval>& f, std::size_t coefficient) noexcept {
        const auto middle = [coefficient](const TaylorInterval& number) {
            const IntervalNumber& range = number.coefficient(coefficient);
            return 0.5 * (range.lower() + range.upper());
        };
        return {middle(f.x), middle(f.y), middle(f.z)};
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

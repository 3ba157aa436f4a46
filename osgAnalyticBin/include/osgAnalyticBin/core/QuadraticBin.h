// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/AnalyticMapping.h>
#include <osgAnalyticBin/core/KernelData.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/QuadraticRange.h>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// The second-order Taylor model of a mapping over a parameter box, with a proven bound of what it leaves out: the
/// quadratic bin. The signed distance of the mapped box to a plane is a quadratic polynomial over the box, give or
/// take the remainder.
/// Source: [JJ] eq. (2), (3); remainder and range: doc/derivation.md, sections 3 and 4.
class QuadraticBin final {
public:
    /// `margin` (metres) is added on all sides: what is drawn may leave the mapped box by that much.
    /// Cost: one evaluation of the mapping and its derivatives.
    QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin = 0.0) noexcept;

    /// The bin that these are the data of.
    explicit QuadraticBin(const QuadraticBinData& data) noexcept : _data(data) {}

    /// Guarantee: Outside only if distance(f(x)) < 0, Inside only if >= 0, for every x in the box and every point
    /// within the margin of f(x); tests: QuadraticBin.NeverContradictsASample, Soundness.HasNoFalseVerdict.
    /// Requires: plane.normal of unit length to 1e-9. A plane with NaN is Straddling.
    /// Cost: four multiplications for most planes (a sphere), about 60 beside the bin (intervals), some 300 where only
    /// the exact range tells.
    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

    /// An interval that holds the signed distance of every point of the mapped box, margin included.
    [[nodiscard]] Interval distanceRange(const Plane& plane) const noexcept;

    /// The model's signed distance to the plane as a polynomial over the unit box, without remainder and margin.
    [[nodiscard]] Quadratic distanceModel(const Plane& plane) const noexcept;

    /// Upper bound of |f(x) - model(x)| over the box, plus the margin and the rounding of both, in metres.
    [[nodiscard]] double remainder() const noexcept { return _data.remainder; }

    /// How far the model leaves the convex hull of its eight corners at most, in metres.
    [[nodiscard]] double bulge() const noexcept;

    /// The model's point at a position of the unit box.
    [[nodiscard]] glm::dvec3 modelPoint(const glm::dvec3& unit) const noexcept;

    /// What the kernels read.
    [[nodiscard]] const QuadraticBinData& data() const noexcept { return _data; }

    /// What classify() leaves to the exact range, which decides every plane.
    [[nodiscard]] Side classifyByExactRange(const Plane& plane) const noexcept;

private:
    [[nodiscard]] glm::dvec3 value() const noexcept {
        return {_data.sphere.center[0], _data.sphere.center[1], _data.sphere.center[2]};
    }
    [[nodiscard]] glm::dvec3 first(std::size_t i) const noexcept;
    [[nodiscard]] glm::dvec3 second(std::size_t i) const noexcept;
    /// What the exact evaluation may be off by: remainder, margin and rounding.
    [[nodiscard]] double uncertainty(const Plane& plane) const noexcept;
    [[nodiscard]] double farthestCorner() const noexcept;

    QuadraticBinData _data;
};

static_assert(sizeof(QuadraticBin) <= 256, "a database holds one for every tile");

}  // namespace osgAnalyticBin::core

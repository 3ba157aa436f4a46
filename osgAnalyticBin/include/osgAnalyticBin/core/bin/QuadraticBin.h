// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/core/bin/KernelData.h>
#include <osgAnalyticBin/core/bin/QuadraticRange.h>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// The second-order Taylor model of a mapping over a parameter box, with a proven bound of what it leaves out: the
/// quadratic bin. The signed distance of the mapped box to a plane is a quadratic polynomial over the box, give or
/// take the remainder.
/// Source: [JJ] eq. (2), (3); remainder and range: doc/theory/derivation.md, sections 3 and 4.
class QuadraticBin final {
public:
    /// `margin` (metres) is added on all sides: what is drawn may leave the mapped box by that much.
    /// Cost: one evaluation of the mapping and its derivatives.
    QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin = 0.0) noexcept;

    /// Makes the bin from its numbers, in the order of row::Quadratic and `stride` apart.
    explicit QuadraticBin(const double* numbers, std::size_t stride = 1) noexcept;

    /// Guarantee: Outside only if distance(f(x)) < 0, Inside only if >= 0, for every x in the box and every point
    /// within the margin of f(x); tests: Soundness.HasNoFalseVerdict.
    /// Requires: plane.normal of unit length to 1e-9. A plane with NaN is Straddling.
    /// Cost: four multiplications for most planes (a sphere), about 60 beside the bin (intervals), some 300 where only
    /// the exact range tells.
    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

    /// An interval that holds the signed distance of every point of the mapped box, margin included.
    [[nodiscard]] Interval distanceRange(const Plane& plane) const noexcept;

    /// The model's signed distance to the plane as a polynomial over the unit box, without remainder and margin.
    [[nodiscard]] Quadratic distanceModel(const Plane& plane) const noexcept;

    /// Upper bound of |f(x) - model(x)| over the box, plus the margin and the rounding of both, in metres.
    [[nodiscard]] double remainder() const noexcept { return _numbers[row::Remainder]; }

    /// An upper bound of how far the model leaves the convex hull of its eight corners, in metres.
    [[nodiscard]] double bulge() const noexcept;

    /// The model's point at a position of the unit box.
    [[nodiscard]] glm::dvec3 modelPoint(const glm::dvec3& unit) const noexcept;

    /// @{
    /// For isSeparated(): of the linear part of the model, which is the whole of it where the mapping is linear.
    [[nodiscard]] glm::dvec3 hullPoint() const noexcept { return value(); }
    /// A point of it that is farthest along the direction.
    [[nodiscard]] glm::dvec3 supportPoint(const glm::dvec3& direction) const noexcept;
    /// No point of the bin is farther from the origin.
    [[nodiscard]] double reach() const noexcept;
    /// @}

    /// What the kernels read: row::Quadratic.
    [[nodiscard]] const std::array<double, row::QuadraticEnd>& numbers() const noexcept { return _numbers; }

    /// What classify() leaves to the exact range, which decides every plane.
    [[nodiscard]] Side classifyByExactRange(const Plane& plane) const noexcept;

private:
    [[nodiscard]] glm::dvec3 vector(std::size_t i) const noexcept {
        return {_numbers[i], _numbers[i + 1], _numbers[i + 2]};
    }
    [[nodiscard]] glm::dvec3 value() const noexcept { return vector(row::CenterX); }
    [[nodiscard]] glm::dvec3 first(std::size_t i) const noexcept { return vector(row::First + 3 * i); }
    [[nodiscard]] glm::dvec3 second(std::size_t i) const noexcept { return vector(row::Second + 3 * i); }
    void setVector(std::size_t i, const glm::dvec3& value) noexcept;
    /// The error of the exact evaluation: remainder, margin and rounding.
    [[nodiscard]] double uncertainty(const Plane& plane) const noexcept;
    [[nodiscard]] double farthestCorner() const noexcept;

    std::array<double, row::QuadraticEnd> _numbers{};
};

static_assert(sizeof(QuadraticBin) <= 264, "a database holds one for every tile");

/// Tests the bin against the undecided planes of a set: see classifyNumbers().
[[nodiscard]] inline Side classify(const QuadraticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return classifyNumbers(bin.numbers().data(), false, planes, undecided);
}

}  // namespace osgAnalyticBin::core

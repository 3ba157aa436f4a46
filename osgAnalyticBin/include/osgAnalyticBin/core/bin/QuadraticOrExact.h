// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <variant>

namespace osgAnalyticBin::core {

/// A bin takes the closed form when the Taylor remainder exceeds this part of the bin's largest extent: from some
/// 8 degrees on, on the earth. The range of a quadratic bin that is kept exceeds the true one by at most twice as much;
/// a start tile of 22.5 degrees would be 2.9 % too large, and one plane in fifteen beside it would need the exact range
/// of the polynomial, which costs more than the closed form.
inline constexpr double kLargestRelativeRemainder = 1.0 / 512.0;

/// A geodetic bin in one of its two forms.
using QuadraticOrExact = std::variant<QuadraticBin, ExactGeodeticBin>;

/// Returns: the quadratic bin of a geodetic bin where its error is small, or where ExactGeodeticBin::holds() is false;
/// the exact one elsewhere. Requires: the bin is not empty.
/// Guarantee: without margin and rounding its distanceRange() exceeds the true one on either side by at most 1/256 of
/// the bin's largest extent, where ExactGeodeticBin::holds(); tests: QuadraticOrExact.*.
/// Cost: a bound of the remainder, and the preparation of the bin that it returns.
[[nodiscard]] QuadraticOrExact quadraticOrExact(const Ellipsoid& ellipsoid, const GeodeticBin& bin,
                                                double margin = 0.0) noexcept;

/// As of the bin itself.
[[nodiscard]] inline Side classify(const QuadraticOrExact& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return std::visit([&](const auto& form) { return classify(form, planes, undecided); }, bin);
}

}  // namespace osgAnalyticBin::core

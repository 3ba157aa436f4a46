// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <variant>

namespace osgAnalyticBin::core {

/// The quadratic bin of a geodetic bin where its error is small, the exact one elsewhere.
using GeodeticQuadraticBin = std::variant<QuadraticBin, ExactGeodeticBin>;

/// A bin is handed to the closed form when the Taylor remainder exceeds this part of the bin's largest extent: from
/// some 8 degrees on, on the earth. The range of a quadratic bin that is kept exceeds the true one by at most twice as
/// much; a start tile of 22.5 degrees would be 2.9 % too large, and one plane in fifteen beside it would need the exact
/// range of the polynomial, which costs more than the closed form.
inline constexpr double kLargestRelativeRemainder = 1.0 / 512.0;

/// Guarantee: without margin and rounding, distanceRange() exceeds the true range on either side by at most 1/256 of
/// the bin's largest extent, for bins of which ExactGeodeticBin::holds() is true; tests: GeodeticQuadraticBin.*.
/// Requires: the bin is not empty.
/// Cost: that of the quadratic bin, and for wide bins that of the exact one as well.
[[nodiscard]] GeodeticQuadraticBin quadraticOrExact(const Ellipsoid& ellipsoid, const GeodeticBin& bin,
                                                    double margin = 0.0) noexcept;

[[nodiscard]] inline Side classify(const GeodeticQuadraticBin& bin, const PlaneSet& planes,
                                   PlaneMask& undecided) noexcept {
    if (const auto* exact = std::get_if<ExactGeodeticBin>(&bin)) return classify(*exact, planes, undecided);
    return classify(*std::get_if<QuadraticBin>(&bin), planes, undecided);
}

}  // namespace osgAnalyticBin::core

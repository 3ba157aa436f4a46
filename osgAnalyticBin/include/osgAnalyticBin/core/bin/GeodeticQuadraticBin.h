// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <array>

namespace osgAnalyticBin::core {

/// A bin is handed to the closed form when the Taylor remainder exceeds this part of the bin's largest extent: from
/// some 8 degrees on, on the earth. The range of a quadratic bin that is kept exceeds the true one by at most twice as
/// much; a start tile of 22.5 degrees would be 2.9 % too large, and one plane in fifteen beside it would need the exact
/// range of the polynomial, which costs more than the closed form.
inline constexpr double kLargestRelativeRemainder = 1.0 / 512.0;

/// The quadratic bin of a geodetic bin where its error is small, the exact one elsewhere.
class GeodeticQuadraticBin final {
public:
    /// Requires: the bin is not empty.
    /// Cost: that of the quadratic bin, and for wide bins that of the exact one as well.
    GeodeticQuadraticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) noexcept;

    /// Whether the bin is in the closed form.
    [[nodiscard]] bool isExact() const noexcept { return _isExact; }

    /// As QuadraticBin::classify() and ExactGeodeticBin::classify().
    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

    /// Guarantee: holds the true range; without margin and rounding, exceeds it on either side by at most 1/256 of the
    /// bin's largest extent, for bins of which ExactGeodeticBin::holds() is true; tests: GeodeticQuadraticBin.*.
    [[nodiscard]] Interval distanceRange(const Plane& plane) const noexcept;

    /// What the kernels read: row::Exact or row::Quadratic.
    [[nodiscard]] const std::array<double, row::kBinRows>& numbers() const noexcept { return _numbers; }

private:
    std::array<double, row::kBinRows> _numbers{};
    bool _isExact;
};

static_assert(sizeof(GeodeticQuadraticBin) <= 272, "a database holds one for every tile");

}  // namespace osgAnalyticBin::core

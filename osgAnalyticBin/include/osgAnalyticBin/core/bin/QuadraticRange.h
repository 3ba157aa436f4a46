// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <array>

namespace osgAnalyticBin::core {

/// A quadratic polynomial q(x) = value + gradient.x + 1/2 x'Hx over the unit box [-1, 1]^3.
struct Quadratic {
    /// At the centre.
    double value = 0.0;
    /// u, v, w
    std::array<double, 3> gradient{};
    /// uu, vv, ww, uv, uw, vw
    std::array<double, 6> hessian{};

    /// q at a position.
    [[nodiscard]] double operator()(double u, double v, double w) const noexcept;
};

/// The exact range of q over the unit box: all vertices, edges, faces and the interior, each by its own stationary
/// point. The nine points of [JJ] are not enough: an extremum may lie on an edge or a face.
/// Guarantee: both ends are attained values, and the true range exceeds them by at most 64 epsilon times the sum of the
/// magnitudes of q's coefficients; tests: QuadraticRange.MatchesAllStationaryPointsInLongDouble.
/// Source: doc/theory/derivation.md, section 4.
[[nodiscard]] Interval exactRange(const Quadratic& q) noexcept;

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <limits>

namespace osgAnalyticBin::core {

/// A remainder that covers the rounding of a formula's value and derivatives too. `size` bounds
/// the sum of the magnitudes of all terms that enter them, derivatives times half sizes; the frame's axes are
/// orthonormal to a few roundings. Source: doc/theory/mappings.md, section 5.
[[nodiscard]] inline double withRounding(double remainder, double size) noexcept {
    constexpr double kRoundUp = 1.0 + 1e-13;
    constexpr double kRoundings = 64.0 * std::numeric_limits<double>::epsilon();
    return remainder * kRoundUp + kRoundings * size;
}

}  // namespace osgAnalyticBin::core

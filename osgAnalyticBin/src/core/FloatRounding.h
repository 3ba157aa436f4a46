// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

/// A float that is greater than the value.
[[nodiscard]] inline float roundedUp(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// The largest float that is not greater than the value.
[[nodiscard]] inline float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
                                                : nearest;
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace osgAnalyticBin::support {

/// Seconds as people say them: "40 s", "12 min", "3 h 05 min".
[[nodiscard]] inline std::string durationText(double seconds) {
    char text[64];
    const double minutes = std::ceil(seconds / 60.0);
    if (seconds < 90.0) {
        std::snprintf(text, sizeof text, "%.0f s", std::ceil(seconds));
    } else if (minutes < 90.0) {
        std::snprintf(text, sizeof text, "%.0f min", minutes);
    } else {
        const double hours = std::floor(minutes / 60.0);
        std::snprintf(text, sizeof text, "%.0f h %02.0f min", hours, minutes - 60.0 * hours);
    }
    return text;
}

/// Estimates the time that is left when `share` (0 to 1) of the work took `seconds`: "12 min left". Empty in the first
/// seconds, when the estimate would be too rough.
[[nodiscard]] inline std::string timeLeft(double share, double seconds) {
    constexpr double kFirstSeconds = 3.0;
    if (!(share > 0.0) || share >= 1.0 || seconds < kFirstSeconds) return {};
    return durationText(seconds * (1.0 - share) / share) + " left";
}

}  // namespace osgAnalyticBin::support

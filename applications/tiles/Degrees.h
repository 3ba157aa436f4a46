// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::tiles {

struct PositionDeg {
    double latitudeDeg = 0.0;
    double longitudeDeg = 0.0;
};

struct RectDeg {
    double west = 0.0;
    double south = 0.0;
    double east = 0.0;
    double north = 0.0;

    /// The same rectangle with a border on all sides, cut at the poles.
    [[nodiscard]] RectDeg grownBy(double borderDeg) const noexcept {
        return {west - borderDeg, std::max(south - borderDeg, -90.0), east + borderDeg,
                std::min(north + borderDeg, 90.0)};
    }

    /// The same area, moved by whole turns so that it lies next to the other one.
    [[nodiscard]] RectDeg turnedTo(const RectDeg& other) const noexcept {
        const double turn = 360.0 * std::round((0.5 * (other.west + other.east) - 0.5 * (west + east)) / 360.0);
        return {west + turn, south, east + turn, north};
    }

    /// The area in square degrees that the rectangles have in common, longitudes modulo 360.
    [[nodiscard]] double overlap(const RectDeg& other) const noexcept {
        const double height = std::min(north, other.north) - std::max(south, other.south);
        double width = 0.0;
        for (const double turn : {-720.0, -360.0, 0.0, 360.0, 720.0})
            width += std::max(0.0, std::min(east + turn, other.east) - std::max(west + turn, other.west));
        return width * std::max(0.0, height);
    }
};

}  // namespace osgAnalyticBin::tiles

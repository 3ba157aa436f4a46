// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../../core/EarthScale.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

/// The rounding of float vertices when they are drawn: a centimetre on the earth, in metres.
[[nodiscard]] inline double drawingError(const core::Ellipsoid& ellipsoid) {
    return 0.01 * core::earthScale(ellipsoid);
}

/// The same of vertices that are stored with coordinates of up to `largest` units, as in a map or in the frame of the
/// globe. Drivers round matrices and sums to float: to 2.9e-7 of the largest coordinate in millions of random views.
[[nodiscard]] inline double drawingErrorOf(double largest) {
    constexpr double kFloatRounding = 4e-7;
    return kFloatRounding * largest;
}

/// The largest coordinate of a bin in a map, in its units.
[[nodiscard]] inline double largestCoordinate(const core::GeodeticBin& bin) {
    const auto largest = [](const core::Interval& range) {
        return std::max(std::abs(range.lower), std::abs(range.upper));
    };
    return std::max(core::Ellipsoid::kMapUnitsInRadian * std::max(largest(bin.latitude()), largest(bin.longitude())),
                    largest(bin.altitude()));
}

/// What is higher is no terrain: 50 km on the earth, in proportion on larger globes and in smaller units. Small bodies
/// have higher mountains for their size, a tenth of the radius at most.
[[nodiscard]] inline double highestTerrain(const core::Ellipsoid& ellipsoid) {
    constexpr double kHighest = 5.0e4;
    const double smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    return std::min(kHighest * std::max(1.0, core::earthScale(ellipsoid)), 0.1 * smaller);
}

/// What is lower is no mesh of terrain, however coarse: 1000 km below the ellipsoid on the earth, in proportion on
/// other globes, and half of the smallest radius of curvature at most.
[[nodiscard]] inline double lowestMesh(const core::Ellipsoid& ellipsoid) {
    constexpr double kLowest = 1.0e6;
    return -std::min(kLowest * core::earthScale(ellipsoid), core::deepestPost(ellipsoid));
}

}  // namespace osgAnalyticBin

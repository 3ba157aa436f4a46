// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <algorithm>

namespace osgAnalyticBin::core {

/// Factor that converts lengths chosen for the earth, in metres, to another globe or another unit. Exactly 1 for WGS
/// 84. The unit of a map is not known; lengths in feet are large enough for metres, too.
[[nodiscard]] inline double earthScale(const Ellipsoid& ellipsoid) noexcept {
    constexpr double kEarth = 6378137.0, kFeetInMetre = 1.0 / 0.3048;
    if (ellipsoid.isPlane()) return kFeetInMetre;
    return ellipsoid.equatorialRadius() / kEarth;
}

/// The smallest radius of curvature: deeper below the ellipsoid, altitude and latitude are no longer one to one with
/// points.
[[nodiscard]] inline double smallestCurvatureRadius(const Ellipsoid& ellipsoid) noexcept {
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    return std::min(a * (a / b), b * (b / a));
}

/// The largest radius of curvature, that of the flattest curve of the surface.
[[nodiscard]] inline double largestCurvatureRadius(const Ellipsoid& ellipsoid) noexcept {
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    return std::max({a * a / b, b * b / a, a});
}

/// The largest |e²| of an ellipsoid for which the bounds of doc/theory/occlusion.md hold.
inline constexpr double kRoundest = 0.01;

/// Terrain is nowhere deeper than this fraction of the smallest radius of curvature.
inline constexpr double kDeepestPost = 0.5;

/// The same as a depth below the ellipsoid.
[[nodiscard]] inline double deepestPost(const Ellipsoid& ellipsoid) noexcept {
    return kDeepestPost * smallestCurvatureRadius(ellipsoid);
}

}  // namespace osgAnalyticBin::core

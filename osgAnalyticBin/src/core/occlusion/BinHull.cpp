// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "SurfaceGrid.h"

#include <osgAnalyticBin/core/occlusion/BinHull.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

std::array<BinHull, 4> hullsOfQuarters(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin,
                                       const Frame& frame) noexcept {
    const Interval &latitude = bin.latitude(), &longitude = bin.longitude(), &altitude = bin.altitude();
    const SurfaceGrid<3> grid(ellipsoid, {latitude.lower, latitude.middle(), latitude.upper},
                              {longitude.lower, longitude.middle(), longitude.upper}, 3, frame);
    // doc/theory/occlusion.md, section 4: second derivatives by latitude and by longitude, an eighth of the widths'
    // squares
    const double radius =
        1.001 * largestCurvatureRadius(ellipsoid) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
    const double cosine = std::cos(std::max({0.0, latitude.lower, -latitude.upper}));
    const double north = 0.5 * latitude.width(), east = 0.5 * longitude.width();
    const double bulge = (north * north + cosine * east * east) * radius / 8.0;
    const bool isRound = std::abs(ellipsoid.eccentricitySquared()) <= kRoundest;
    const double reach = bulge + margin + 32.0 * kEpsilon * radius;
    std::array<BinHull, 4> hulls;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        for (std::size_t i = 0; i < 8; ++i) {
            const auto ring = grid.ring(quarter / 2 + i / 2 % 2, i < 4 ? altitude.lower : altitude.upper);
            hulls[quarter].corners[i] = grid.point(ring, quarter % 2 + i % 2);
        }
        hulls[quarter].reach = isRound ? reach : std::numeric_limits<double>::infinity();
    }
    return hulls;
}

}  // namespace osgAnalyticBin::core

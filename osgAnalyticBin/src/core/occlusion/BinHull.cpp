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

BinHull::BinHull(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept
    : reach(std::numeric_limits<double>::infinity()) {
    const Interval &latitude = bin.latitude(), &longitude = bin.longitude(), &altitude = bin.altitude();
    const SurfaceGrid<2, 2> grid(ellipsoid, {latitude.lower, latitude.upper}, {longitude.lower, longitude.upper});
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = grid.point(i / 2 % 2, i % 2, i < 4 ? altitude.lower : altitude.upper);
    if (!(std::abs(ellipsoid.eccentricitySquared()) <= kRoundest)) return;
    // doc/occlusion.md, section 4: second derivatives by latitude and by longitude, an eighth of the widths' squares
    const double radius =
        1.001 * largestCurvatureRadius(ellipsoid) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
    const double cosine = std::cos(std::max({0.0, latitude.lower, -latitude.upper}));
    const double bulge =
        (latitude.width() * latitude.width() + cosine * longitude.width() * longitude.width()) * radius / 8.0;
    reach = bulge + margin + 32.0 * kEpsilon * radius;
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/mesh/FinerMeshes.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Posts stand on the terrain, a little farther from the centre than the ellipsoid; of the largest radius of curvature.
constexpr double kRoomForAltitude = 1.01;

// Between the square tiles of a quadtree and the whole globe, which VirtualPlanetBuilder parts into two.
constexpr double kWide = 1.5;

// The flattest curve of the surface has the largest radius of curvature; posts as high as `altitude` stand above it.
double largestRadius(const Ellipsoid& ellipsoid, double altitude) noexcept {
    const double largest = largestCurvatureRadius(ellipsoid);
    return std::max(kRoomForAltitude * largest, largest + altitude);
}

}  // namespace

double sagOfArc(const Ellipsoid& ellipsoid, double angle, double altitude) noexcept {
    if (!(angle < kPi)) return 2.0 * std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    return largestRadius(ellipsoid, altitude) * (1.0 - std::cos(0.5 * angle));
}

double sagOfFinerMeshes(const Ellipsoid& ellipsoid, const GeodeticBin& tile, bool areGrids) noexcept {
    const Interval& latitude = tile.latitude();
    const double nearest = latitude.contains(0.0) ? 0.0 : std::min(std::abs(latitude.lower), std::abs(latitude.upper));
    // a tile much wider than high is halved in longitude alone
    const bool isWide = tile.longitude().width() > kWide * latitude.width();
    const double height = isWide ? latitude.width() : 0.5 * latitude.width();
    const double diagonal = std::hypot(0.5 * tile.longitude().width() * std::cos(nearest), height);
    return sagOfArc(ellipsoid, areGrids ? diagonal / kFewestCells : diagonal, tile.altitude().upper);
}

}  // namespace osgAnalyticBin::core

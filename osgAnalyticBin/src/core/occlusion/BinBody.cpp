// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "PlateCells.h"

#include <osgAnalyticBin/core/occlusion/BinBody.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

// Positions are linear in altitude.
void BinHull::lowerTop(double top, const Interval& altitude) noexcept {
    const double share = std::max(top - altitude.lower, 0.0) / altitude.width();
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 bottom = corner(i);
        setCorner(i + 4, bottom + share * (corner(i + 4) - bottom));
    }
}

BinBody::BinBody(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin, const InverseFrame& frame) noexcept
    : _ellipsoid(ellipsoid),
      _bin(bin),
      _margin(margin),
      _frame(frame),
      _middle(sinesOfMiddle(bin.latitude(), bin.longitude())) {}

// A radius of curvature at the bin's altitudes, or more: M changes within the bin.
double BinBody::largestRadius() const noexcept {
    const Interval& altitude = _bin.altitude();
    return 1.001 * largestCurvatureRadius(_ellipsoid) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

// As Ellipsoid::toEcef(), with less trigonometry.
glm::dvec3 BinBody::middle() const noexcept {
    if (_ellipsoid.isPlane()) return _ellipsoid.toEcef(_bin.center());
    const auto [sinLat, cosLat, sinLon, cosLon] = _middle;
    const double radius = _ellipsoid.primeVerticalRadius(sinLat, cosLat), altitude = _bin.altitude().middle();
    const double rho = (radius + altitude) * cosLat;
    return {rho * cosLon, rho * sinLon, (_ellipsoid.squaredRatio() * radius + altitude) * sinLat};
}

BinBall BinBody::ball() const noexcept {
    // from the middle along its meridian, along a parallel and along a vertical
    const double north = 0.5 * _bin.latitude().width(), east = 0.5 * _bin.longitude().width();
    const double axisward = _ellipsoid.isPlane() ? 1.0 : std::min(1.0, _middle[1] + north);
    const double reach = largestRadius() * (north + axisward * east + 32.0 * kEpsilon) + 0.5 * _bin.altitude().width();
    return {_frame.turned(middle()) - _frame.origin, reach + _margin};
}

std::array<BinHull, 4> BinBody::quarters() const noexcept {
    constexpr std::size_t kLanes = kernels::kMostLanes;
    using Lanes = std::array<double, kLanes>;
    constexpr Lanes kSouth{-0.5, -0.5, 0.0, 0.0}, kNorth{0.0, 0.0, 0.5, 0.5};
    constexpr Lanes kWest{-0.5, 0.0, -0.5, 0.0}, kEast{0.0, 0.5, 0.0, 0.5};
    Lanes high;
    high.fill(_bin.altitude().upper);
    std::array<double, 24 * kLanes> corners;
    kernels::activeOcclusion.columns(
        cellGround(_ellipsoid, _bin.latitude(), _bin.longitude(), _middle, _bin.altitude().width(), _frame),
        {kSouth.data(), kNorth.data(), kWest.data(), kEast.data(), high.data(), 4}, corners.data(), kLanes);

    const double north = 0.5 * _bin.latitude().width(), east = 0.5 * _bin.longitude().width();
    const Interval& latitude = _bin.latitude();
    // of the latitude nearest to the equator
    const double nearest = std::max({0.0, latitude.lower, -latitude.upper});
    const double cosine = _ellipsoid.isPlane() ? 1.0 : std::cos(nearest);
    // doc/theory/occlusion.md, section 4: second derivatives by latitude and by longitude, an eighth of the widths'
    // squares
    const double radius = largestRadius(), bulge = (north * north + cosine * east * east) * radius / 8.0;
    const bool isKnown = std::abs(_ellipsoid.eccentricitySquared()) <= kRoundest &&
                         std::max(north, east) <= kernels::kFarthestFromMiddle;
    std::array<BinHull, 4> hulls;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        BinHull& hull = hulls[quarter];
        hull.reach = isKnown ? bulge + _margin + 32.0 * kEpsilon * radius : std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 8; ++i) {
            // those of columns begin with the upper ones
            const double* const corner = &corners[3 * ((i + 4) % 8) * kLanes + quarter];
            hull.setCorner(i, {corner[0], corner[kLanes], corner[2 * kLanes]});
        }
    }
    return hulls;
}

}  // namespace osgAnalyticBin::core

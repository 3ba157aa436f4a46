// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/occlusion/BinBody.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

// Positions are linear in altitude.
void BinHull::lowerTop(double share) noexcept {
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 bottom = corner(i);
        setCorner(i + 4, bottom + share * (corner(i + 4) - bottom));
    }
}

BinBody::Angle::Angle(double radians) noexcept : sine(std::sin(radians)), cosine(std::cos(radians)) {}

BinBody::Angle BinBody::Angle::plus(const Angle& other) const noexcept {
    return {sine * other.cosine + cosine * other.sine, cosine * other.cosine - sine * other.sine};
}

// The same angle between two that are half a width away.
std::array<BinBody::Angle, 3> BinBody::Angle::withEnds(double half) const noexcept {
    const Angle step(half);
    return {plus({-step.sine, step.cosine}), *this, plus(step)};
}

BinBody::BinBody(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin, const InverseFrame& frame) noexcept
    : _ellipsoid(ellipsoid),
      _bin(bin),
      _margin(margin),
      _frame(frame),
      _latitude(bin.latitude().middle()),
      _longitude(bin.longitude().middle()) {}

// [DERIVATION] section 1: ECEF of a geodetic position is rho (cos l, sin l, 0) + z (0, 0, 1).
BinBody::Ring BinBody::ring(const Angle& latitude, double altitude) const noexcept {
    const double radius = _ellipsoid.primeVerticalRadius(latitude.sine, latitude.cosine);
    const double z = (_ellipsoid.squaredRatio() * radius + altitude) * latitude.sine;
    return {(radius + altitude) * latitude.cosine, z * _frame.z - _frame.origin};
}

BinBody::Ring BinBody::ringInMap(double latitude, double altitude) const noexcept {
    return {Ellipsoid::kMapUnitsInRadian,
            Ellipsoid::kMapUnitsInRadian * latitude * _frame.y + altitude * _frame.z - _frame.origin};
}

// A radius of curvature at the bin's altitudes, or more: M changes within the bin.
double BinBody::largestRadius() const noexcept {
    const Interval& altitude = _bin.altitude();
    return 1.001 * largestCurvatureRadius(_ellipsoid) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

BinBall BinBody::ball() const noexcept {
    const Interval &latitude = _bin.latitude(), &longitude = _bin.longitude(), &altitude = _bin.altitude();
    const bool isMap = _ellipsoid.isPlane();
    const Ring middle = isMap ? ringInMap(latitude.middle(), altitude.middle()) : ring(_latitude, altitude.middle());
    const glm::dvec3 meridian =
        isMap ? longitude.middle() * _frame.x : _longitude.cosine * _frame.x + _longitude.sine * _frame.y;
    // from the middle along its meridian, along a parallel and along a vertical
    const double north = 0.5 * latitude.width(), east = 0.5 * longitude.width();
    const double axisward = isMap ? 1.0 : std::min(1.0, _latitude.cosine + north);
    const double reach = largestRadius() * (north + axisward * east + 32.0 * kEpsilon) + 0.5 * altitude.width();
    return {middle.axisDistance * meridian + middle.middle, reach + _margin};
}

std::array<BinHull, 4> BinBody::quarters() const noexcept {
    const Interval &latitude = _bin.latitude(), &longitude = _bin.longitude(), &altitude = _bin.altitude();
    const double north = 0.5 * latitude.width(), east = 0.5 * longitude.width();
    const bool isMap = _ellipsoid.isPlane();
    const std::array<Angle, 3> rows = _latitude.withEnds(north), columns = _longitude.withEnds(east);
    std::array<glm::dvec3, 3> meridians;
    for (std::size_t i = 0; i < 3; ++i) meridians[i] = columns[i].cosine * _frame.x + columns[i].sine * _frame.y;
    if (isMap) meridians = {longitude.lower * _frame.x, longitude.middle() * _frame.x, longitude.upper * _frame.x};
    // the cosine of the latitude nearest to the equator
    const bool isAcrossEquator = isMap || rows[0].sine * rows[2].sine <= 0.0;
    const double cosine = isAcrossEquator ? 1.0 : std::max(rows[0].cosine, rows[2].cosine);
    // doc/theory/occlusion.md, section 4: second derivatives by latitude and by longitude, an eighth of the widths'
    // squares
    const double radius = largestRadius(), bulge = (north * north + cosine * east * east) * radius / 8.0;
    const bool isRound = std::abs(_ellipsoid.eccentricitySquared()) <= kRoundest;
    const double reach = bulge + _margin + 32.0 * kEpsilon * radius;
    std::array<BinHull, 4> hulls;
    for (BinHull& hull : hulls) hull.reach = isRound ? reach : std::numeric_limits<double>::infinity();
    const std::array<double, 3> latitudes{latitude.lower, latitude.middle(), latitude.upper};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t end = 0; end < 2; ++end) {
            const double height = end == 0 ? altitude.lower : altitude.upper;
            const Ring at = isMap ? ringInMap(latitudes[row], height) : ring(rows[row], height);
            std::array<glm::dvec3, 3> points;
            for (std::size_t i = 0; i < 3; ++i) points[i] = at.axisDistance * meridians[i] + at.middle;
            // rows and columns in the middle belong to the quarters on both sides
            for (std::size_t quarter = 0; quarter < 4; ++quarter) {
                const std::size_t northward = row - quarter / 2, west = quarter % 2;
                if (northward > 1) continue;
                hulls[quarter].setCorner(4 * end + 2 * northward, points[west]);
                hulls[quarter].setCorner(4 * end + 2 * northward + 1, points[west + 1]);
            }
        }
    }
    return hulls;
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

[[maybe_unused]] constexpr double kMaxCell = 1.0472;
// Sines are taken for angles in the bound of the poleward run, and the last bits of its own evaluation are covered.
constexpr double kRunSlack = 1.01;
constexpr double kAngleRounding = 1e-15;
constexpr double kLengthRounding = 1e-7;  // metres on the earth

double squared(double value) {
    return value * value;
}

// Half a cell, as the haversines that a chord's ends are away from the cell's middle.
struct HalfCell {
    double latitude;   // of half a row, in reduced or geodetic latitude, whichever is larger
    double longitude;  // of half a column, at the equator
};

// 1 - cos of the angle between a cell's middle and its corners, at most, where the cosine of the latitude is
// `cosLatitude` at most.
double versine(const HalfCell& half, double cosLatitude) {
    return 2.0 * (half.latitude + cosLatitude * cosLatitude * half.longitude);
}

double haversine(double angle) {
    return squared(std::sin(0.5 * angle));
}

// Where the closed forms hold.
bool isEarthLike(const Ellipsoid& ellipsoid, double reach, double skirt) {
    const double smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    return reach < 0.1 * smaller && skirt < smaller / 3.0 && std::abs(ellipsoid.eccentricitySquared()) < 0.1;
}

// The latitude up to which chords between posts of the parallel `latitude` >= 0 run, `halfColumn` radians either way.
// `depth`: metres, of the deepest post.
double polewardLimit(const Ellipsoid& ellipsoid, double latitude, double cosHalfColumn, double depth) {
    const double fromAxis = std::atan2(std::sin(latitude), std::cos(latitude) * cosHalfColumn);
    const double e2 = ellipsoid.eccentricitySquared();
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    const double lag = e2 > 0.0 ? kRunSlack * e2 * (a / b) * (a / b) * a * a / (b * (a - depth) * cosHalfColumn) : 0.0;
    const double run = std::max(0.0, fromAxis - latitude) / (1.0 - lag);
    return std::min(kHalfPi, latitude + run + kAngleRounding);
}

}  // namespace

GeodeticGridBounds::GeodeticGridBounds(const Ellipsoid& ellipsoid, const GeodeticGrid& grid, double reach,
                                       double skirt) noexcept
    : _latitude(grid.latitude) {
    const double row = grid.latitude.width() / static_cast<double>(grid.rows - 1);
    const double column = grid.longitude.width() / static_cast<double>(grid.columns - 1);
    assert(grid.columns >= 2 && grid.rows >= 2 && row <= kMaxCell && column <= kMaxCell && reach >= 0.0 &&
           skirt >= 0.0);
    if (ellipsoid.isPlane()) return;
    _isKnown = isEarthLike(ellipsoid, reach, skirt);
    if (!_isKnown) {
        _sag = std::numeric_limits<double>::infinity();
        return;
    }

    const double cosHalfColumn = std::cos(0.5 * column);
    if (grid.latitude.upper > 0.0)
        _latitude.upper = polewardLimit(ellipsoid, grid.latitude.upper, cosHalfColumn, reach + skirt);
    if (grid.latitude.lower < 0.0)
        _latitude.lower = -polewardLimit(ellipsoid, -grid.latitude.lower, cosHalfColumn, reach + skirt);

    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    // Geodetic and reduced latitudes change by a/b and b/a of each other at most: twice, for a middle in reduced
    // latitude as seen in geodetic ones.
    const double oblateness = std::max(a / b, b / a);
    const HalfCell half{haversine(0.5 * row * oblateness * oblateness), haversine(0.5 * column)};
    const auto cosAt = [a, b](double latitude) {
        const double reduced = std::cos(std::atan2(b * std::sin(latitude), a * std::cos(latitude)));
        return std::max(reduced, std::cos(latitude));
    };
    const double rounding = kLengthRounding * earthScale(ellipsoid);
    const double radius = std::max(a, b) + reach;
    const double cosSouth = cosAt(grid.latitude.lower);
    const double cosNorth = cosAt(grid.latitude.upper);
    const bool acrossEquator = grid.latitude.lower <= 0.0 && grid.latitude.upper >= 0.0;
    _sag = radius * versine(half, acrossEquator ? 1.0 : std::max(cosSouth, cosNorth)) + rounding;
}

}  // namespace osgAnalyticBin::core

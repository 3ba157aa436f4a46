// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../occlusion/SurfaceGrid.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Radians by which angles may be wrong.
constexpr double kRounding = 1e-12;

// Of a position at a latitude and altitude: the latitude of its direction in unit space (doc/theory/horizon.md, section
// 2).
double latitudeInUnitSpace(const Ellipsoid& ellipsoid, double latitude, double altitude) {
    const double sine = std::sin(latitude), cosine = std::cos(latitude);
    const double n = ellipsoid.primeVerticalRadius(sine, cosine);
    return std::atan2((n * ellipsoid.squaredRatio() + altitude) * sine / ellipsoid.polarRadius(),
                      (n + altitude) * cosine / ellipsoid.equatorialRadius());
}

// How far a longitude is from the middle of an interval, in radians.
double fromMiddle(const Interval& interval, double longitude) {
    return std::abs(std::remainder(longitude - interval.middle(), 2.0 * kPi));
}

// doc/theory/horizon.md, section 10: whether no segment from the eye to a point at most `apart` radians of longitude
// away, and not north of `border`, passes north of it.
bool staysSouthOf(double border, const Ellipsoid& ellipsoid, const Geodetic& eye, double apart) {
    if (border >= kHalfPi) return true;
    if (!(eye.latitude <= border - kRounding)) return false;
    if (border <= 0.0) return true;
    const glm::dvec3 point = ellipsoid.toEcef({eye.latitude, 0.0, eye.altitude});
    const double sine = std::sin(border);
    const double apex = ellipsoid.eccentricitySquared() * ellipsoid.primeVerticalRadius(sine, std::cos(border)) * sine;
    return std::tan(border) * (point.x * std::cos(apart) - kRounding * ellipsoid.equatorialRadius()) >=
           point.z + apex + kRounding * ellipsoid.equatorialRadius();
}

}  // namespace

CoveredRegion::CoveredRegion(const Ellipsoid& ellipsoid, const GeodeticBin& extents) noexcept : _ellipsoid(ellipsoid) {
    if (std::abs(ellipsoid.eccentricitySquared()) <= kRoundest) _extents = extents;
}

bool CoveredRegion::contains(const GeodeticBin& bin) const noexcept {
    return !_extents.empty() && _extents.withAltitude(bin.altitude()).contains(bin);
}

bool CoveredRegion::holdsHorizon(const HorizonEye& eye) const noexcept {
    const HorizonEyeData& data = eye.data();
    if (_extents.empty() || !(data.cosDip > 0.0)) return false;
    // Directions of lines of sight are within the dip of the eye's direction; their altitudes are below the eye's.
    const double dip = std::atan2(data.sinDip, data.cosDip) + kRounding;
    const double latitude = std::atan2(data.z, data.equatorial);
    const double larger = std::max(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    const double highest = std::max(0.0, data.scale / data.cosDip - 1.0) * larger;
    const double lowest = std::min(0.0, data.scale - 1.0) * larger;
    const auto [south, north] = _extents.latitude();
    const double southern =
        std::max(latitudeInUnitSpace(_ellipsoid, south, lowest), latitudeInUnitSpace(_ellipsoid, south, highest));
    const double northern =
        std::min(latitudeInUnitSpace(_ellipsoid, north, lowest), latitudeInUnitSpace(_ellipsoid, north, highest));
    const bool isFullCircle = _extents.isFullCircle();
    const bool isSouthOpen = isFullCircle && south <= -kHalfPi, isNorthOpen = isFullCircle && north >= kHalfPi;
    if (!isSouthOpen && !(latitude - dip > southern + kRounding)) return false;
    if (!isNorthOpen && !(latitude + dip < northern - kRounding)) return false;
    if (isFullCircle) return true;
    // no pole is within the dip
    if (!(std::abs(latitude) + dip < kHalfPi)) return false;
    const double across = std::asin(std::min(1.0, std::sin(dip) / std::cos(latitude)));
    return fromMiddle(_extents.longitude(), std::atan2(data.y, data.x)) + across + kRounding <
           0.5 * _extents.longitude().width();
}

bool CoveredRegion::holdsSegmentsFrom(const glm::dvec3& eyeEcef) const noexcept {
    if (_extents.empty()) return false;
    const Geodetic eye = _ellipsoid.toGeodetic(eyeEcef);
    const double smaller = std::min(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    if (!(std::abs(eye.altitude) <= 0.1 * smaller)) return false;
    const double half = 0.5 * _extents.longitude().width();
    const double aside = fromMiddle(_extents.longitude(), eye.longitude);
    const double apart = half + aside;
    // the half-planes of two meridians hold a convex wedge
    if (!(aside + kRounding <= half) || !(apart < 0.49 * kPi)) return false;
    const Geodetic mirrored{-eye.latitude, eye.longitude, eye.altitude};
    return staysSouthOf(_extents.latitude().upper, _ellipsoid, eye, apart) &&
           staysSouthOf(-_extents.latitude().lower, _ellipsoid, mirrored, apart);
}

}  // namespace osgAnalyticBin::core

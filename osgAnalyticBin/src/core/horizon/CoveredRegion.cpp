// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Error bound of angles, radians.
constexpr double kRounding = 1e-12;

// Error bound of sums of a few products of sines and cosines.
constexpr double kSlack = 8.0 * kEpsilon;

// Eastward of the middle of an interval, in radians.
double fromMiddle(const Interval& interval, double longitude) {
    return std::remainder(longitude - interval.middle(), 2.0 * kPi);
}

// The latitude in unit space of the direction of a position (doc/theory/horizon.md, section 2).
double latitudeInUnitSpace(const Ellipsoid& ellipsoid, double latitude, double altitude) {
    const double sine = std::sin(latitude), cosine = std::cos(latitude);
    const double n = ellipsoid.primeVerticalRadius(sine, cosine);
    return std::atan2((n * ellipsoid.squaredRatio() + altitude) * sine / ellipsoid.polarRadius(),
                      (n + altitude) * cosine / ellipsoid.equatorialRadius());
}

// doc/theory/horizon.md, section 10: whether no segment from the eye to a point at most `apart` radians of longitude
// away, and not north of `border`, passes north of it.
bool staysSouthOf(double border, const Ellipsoid& ellipsoid, double latitude, const glm::dvec3& eye, double apart) {
    if (border >= kHalfPi) return true;
    if (!(latitude <= border - kRounding)) return false;
    if (border <= 0.0) return true;
    const double axisDistance = std::hypot(eye.x, eye.y);
    const double sine = std::sin(border);
    const double apex = ellipsoid.eccentricitySquared() * ellipsoid.primeVerticalRadius(sine, std::cos(border)) * sine;
    const double rounding = kRounding * ellipsoid.equatorialRadius();
    return std::tan(border) * (axisDistance * std::cos(apart) - rounding) >= eye.z + apex + rounding;
}

}  // namespace

CoveredRegion::CoveredRegion(const Ellipsoid& ellipsoid, const GeodeticBin& extents) noexcept : _ellipsoid(ellipsoid) {
    if (std::abs(ellipsoid.eccentricitySquared()) <= kRoundest) _extents = extents;
}

bool CoveredRegion::contains(const GeodeticBin& bin) const noexcept {
    return !_extents.empty() && _extents.withAltitude(bin.altitude()).contains(bin);
}

bool CoveredRegion::holdsSegmentsFrom(const glm::dvec3& eyeEcef) const noexcept {
    if (_extents.empty()) return false;
    const Geodetic eye = _ellipsoid.toGeodetic(eyeEcef);
    // a rectangle is convex
    if (_ellipsoid.isPlane())
        return contains({{eye.latitude, eye.latitude}, {eye.longitude, eye.longitude}, {0.0, 0.0}});
    const double smaller = std::min(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    if (!(eye.altitude >= -0.1 * smaller)) return false;
    const double half = 0.5 * _extents.longitude().width();
    const double aside = std::abs(fromMiddle(_extents.longitude(), eye.longitude));
    const double apart = half + aside;
    // the half-planes of two meridians hold a convex wedge
    if (!(aside + kRounding <= half) || !(apart < 0.49 * kPi)) return false;
    const glm::dvec3 mirrored(eyeEcef.x, eyeEcef.y, -eyeEcef.z);
    return staysSouthOf(_extents.latitude().upper, _ellipsoid, eye.latitude, eyeEcef, apart) &&
           staysSouthOf(-_extents.latitude().lower, _ellipsoid, -eye.latitude, mirrored, apart);
}

// In unit space, directions of lines of sight up to the occluder are no farther from the eye's than its dip.
bool CoveredRegion::holdsHorizonOf(const HorizonEye& eye) const noexcept {
    const HorizonEyeData& data = eye.data();
    if (_extents.empty() || !(data.cosDip > 0.0)) return false;
    if (!_extents.isFullCircle()) {
        const double aside = std::abs(fromMiddle(_extents.longitude(), std::atan2(data.y, data.x)));
        const double toBorder = 0.5 * _extents.longitude().width() - aside - kRounding;
        // a meridian ends at the poles
        if (!(data.equatorial * std::sin(std::min(toBorder, kHalfPi)) > data.sinDip + kSlack)) return false;
    }
    // altitudes are between the occluder's and the eye's
    const double larger = std::max(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    const double highest = std::max(0.0, data.scale / data.cosDip - 1.0) * larger;
    const double lowest = std::min(0.0, data.scale - 1.0) * larger;
    const double latitude = std::atan2(data.z, data.equatorial), dip = std::atan2(data.sinDip, data.cosDip);
    const auto isSouthOf = [&](double border, double northernmost) {
        return border >= kHalfPi ||
               northernmost + kRounding < std::min(latitudeInUnitSpace(_ellipsoid, border, lowest),
                                                   latitudeInUnitSpace(_ellipsoid, border, highest));
    };
    return isSouthOf(_extents.latitude().upper, dip + latitude) &&
           isSouthOf(-_extents.latitude().lower, dip - latitude);
}

}  // namespace osgAnalyticBin::core

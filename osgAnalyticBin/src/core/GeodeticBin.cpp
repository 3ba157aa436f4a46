// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Constants.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

constexpr double kTwoPi = 2.0 * kPi;
constexpr double kRadiansPerDegree = kPi / 180.0;
// A few units in the last place of an angle near 2 pi: the rounding error of adding or subtracting a turn.
constexpr double kAngleTolerance = 2e-15;
// Doubles of this size are 1e-10 radians apart, a millimetre on the earth.
constexpr double kFarthestLongitude = 1e6;

bool isProper(const Interval& interval) {
    return std::isfinite(interval.lower) && std::isfinite(interval.upper) && interval.lower <= interval.upper;
}

// Bound of the rounding error of moving an angle by `shift`, a rounded multiple of 2 pi, to `angle`: 1.1 epsilon of
// both where they are large.
double turningTolerance(double shift, double angle) {
    return kAngleTolerance * std::max(1.0, (std::abs(shift) + std::abs(angle)) / 8.0 - 1.0);
}

// The offset of an angle east of a start, in [0, 2 pi).
double eastwardOffset(double from, double to) {
    const double offset = std::fmod(to - from, kTwoPi);
    return offset < 0.0 ? offset + kTwoPi : offset;
}

// `interval` moved by whole turns so that it starts in [from, from + 2 pi); rounded outward when it moves.
Interval turnedToStartAfter(const Interval& interval, double from) {
    const double turns = std::floor((interval.lower - from) / kTwoPi);
    if (turns == 0.0) return interval;
    const double shift = turns * kTwoPi;
    const Interval turned{interval.lower - shift, interval.upper - shift};
    const double tolerance = turningTolerance(shift, std::max(std::abs(turned.lower), std::abs(turned.upper)));
    return {turned.lower - tolerance, turned.upper + tolerance};
}

bool holdsLongitude(const Interval& interval, double longitude) {
    if (interval.contains(longitude)) return true;
    const double offset = eastwardOffset(interval.lower, longitude);
    const double tolerance = turningTolerance(longitude - interval.lower, longitude);
    return offset <= interval.width() + tolerance || offset >= kTwoPi - tolerance;
}

bool holdsLongitudes(const Interval& outer, const Interval& inner) {
    if (outer.width() >= kTwoPi || outer.contains(inner)) return true;
    double offset = eastwardOffset(outer.lower, inner.lower);
    const double tolerance = turningTolerance(inner.lower - outer.lower, inner.lower);
    if (offset >= kTwoPi - tolerance) offset = 0.0;
    return offset + inner.width() <= outer.width() + tolerance;
}

Interval longitudeHull(const Interval& a, const Interval& b) {
    if (a.contains(b)) return a;
    if (b.contains(a)) return b;
    const Interval bAfterA = a.united(turnedToStartAfter(b, a.lower));
    const Interval aAfterB = b.united(turnedToStartAfter(a, b.lower));
    const Interval& shorter = bAfterA.width() <= aAfterB.width() ? bAfterA : aAfterB;
    return shorter.width() >= kTwoPi ? Interval{-kPi, kPi} : shorter;
}

}  // namespace

GeodeticBin::GeodeticBin() noexcept
    : _latitude(Interval::none()), _longitude(Interval::none()), _altitude(Interval::none()) {}

GeodeticBin::GeodeticBin(Interval latitude, Interval longitude, Interval altitude) noexcept : GeodeticBin() {
    if (!isProper(latitude) || !isProper(longitude) || !isProper(altitude)) return;
    _latitude = {std::clamp(latitude.lower, -kHalfPi, kHalfPi), std::clamp(latitude.upper, -kHalfPi, kHalfPi)};
    const bool isTooFar = std::max(std::abs(longitude.lower), std::abs(longitude.upper)) > kFarthestLongitude;
    _longitude = isTooFar || longitude.width() >= kTwoPi ? Interval{-kPi, kPi} : longitude;
    _altitude = altitude;
}

GeodeticBin GeodeticBin::fromDegrees(Interval latitudeDeg, Interval longitudeDeg, Interval altitude) noexcept {
    return GeodeticBin({latitudeDeg.lower * kRadiansPerDegree, latitudeDeg.upper * kRadiansPerDegree},
                       {longitudeDeg.lower * kRadiansPerDegree, longitudeDeg.upper * kRadiansPerDegree}, altitude);
}

GeodeticBin GeodeticBin::wholeGlobe(Interval altitude) noexcept {
    return GeodeticBin({-kHalfPi, kHalfPi}, {-kPi, kPi}, altitude);
}

bool GeodeticBin::isFullCircle() const noexcept {
    return _longitude.width() >= kTwoPi;
}

Geodetic GeodeticBin::center() const noexcept {
    return {_latitude.middle(), _longitude.middle(), _altitude.middle()};
}

bool GeodeticBin::contains(const Geodetic& position) const noexcept {
    if (empty()) return false;
    return _latitude.contains(position.latitude) && _altitude.contains(position.altitude) &&
           holdsLongitude(_longitude, position.longitude);
}

bool GeodeticBin::contains(const GeodeticBin& other) const noexcept {
    if (other.empty()) return true;
    if (empty()) return false;
    return _latitude.contains(other._latitude) && _altitude.contains(other._altitude) &&
           holdsLongitudes(_longitude, other._longitude);
}

GeodeticBin GeodeticBin::united(const GeodeticBin& other) const noexcept {
    if (other.empty()) return *this;
    if (empty()) return other;
    GeodeticBin result;
    result._latitude = _latitude.united(other._latitude);
    result._longitude = longitudeHull(_longitude, other._longitude);
    result._altitude = _altitude.united(other._altitude);
    return result;
}

void GeodeticBin::expandBy(const Geodetic& position) noexcept {
    expandBy(GeodeticBin({position.latitude, position.latitude}, {position.longitude, position.longitude},
                         {position.altitude, position.altitude}));
}

GeodeticBin GeodeticBin::withAltitude(Interval altitude) const noexcept {
    return GeodeticBin(_latitude, _longitude, altitude);
}

std::array<GeodeticBin, 4> GeodeticBin::quarters() const noexcept {
    const Interval south{_latitude.lower, _latitude.middle()};
    const Interval north{_latitude.middle(), _latitude.upper};
    const Interval west{_longitude.lower, _longitude.middle()};
    const Interval east{_longitude.middle(), _longitude.upper};
    return {GeodeticBin(south, west, _altitude), GeodeticBin(south, east, _altitude),
            GeodeticBin(north, west, _altitude), GeodeticBin(north, east, _altitude)};
}

bool GeodeticBin::operator==(const GeodeticBin& other) const noexcept {
    return _latitude == other._latitude && _longitude == other._longitude && _altitude == other._altitude;
}

}  // namespace osgAnalyticBin::core

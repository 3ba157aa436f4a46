// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

double wrapped(double angle) {
    return std::remainder(angle, 2.0 * kPi);
}

}  // namespace

GeodeticMeshBounds::GeodeticMeshBounds(const Ellipsoid& ellipsoid, double referenceLongitude,
                                       double axisTolerance) noexcept
    : _ellipsoid(ellipsoid),
      _referenceLongitude(referenceLongitude),
      _reference(std::cos(referenceLongitude), std::sin(referenceLongitude), 0.0),
      _axisTolerance(axisTolerance),
      _latitude(Interval::none()),
      _relativeLongitude(Interval::none()),
      _altitude(Interval::none()),
      _northCone(ellipsoid, 0.0),
      _southCone(ellipsoid, 0.0) {}

void GeodeticMeshBounds::expandByVertex(const glm::dvec3& ecef) noexcept {
    const Geodetic position = _ellipsoid.toGeodetic(ecef);
    _latitude.expandBy(position.latitude);
    _altitude.expandBy(position.altitude);
    if (_ellipsoid.isPlane() || std::hypot(ecef.x, ecef.y) > _axisTolerance) {
        _relativeLongitude.expandBy(wrapped(position.longitude - _referenceLongitude));
    }
}

void GeodeticMeshBounds::expandByTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
    const glm::dvec3 corners[3] = {a, b, c};
    if (_ellipsoid.isPlane()) {
        for (const glm::dvec3& corner : corners) expandByVertex(corner);
        return;
    }
    const glm::dvec3 sum = a + b + c;

    // Altitude is the distance to a convex body: at most the vertices', at least that to a supporting plane.
    const double a2 = _ellipsoid.equatorialRadius() * _ellipsoid.equatorialRadius();
    const double b2 = _ellipsoid.polarRadius() * _ellipsoid.polarRadius();
    const glm::dvec3 gradient(sum.x / a2, sum.y / a2, sum.z / b2);
    const double length = glm::length(gradient);
    // A triangle about the earth's centre has no outward side; any normal gives a bound.
    const glm::dvec3 normal = length > 0.0 ? gradient / length : glm::dvec3(0.0, 0.0, 1.0);
    const double support = _ellipsoid.support(normal);
    for (const glm::dvec3& corner : corners)
        _altitude.lower = std::min(_altitude.lower, glm::dot(normal, corner) - support);

    noteCrossing(corners);

    // Latitude: the distance from the axis is at least its projection on a fixed radial direction, which is linear.
    const double axisDistance = std::hypot(sum.x, sum.y);
    const glm::dvec3 radial = axisDistance > 0.0 ? glm::dvec3(sum.x, sum.y, 0.0) / axisDistance : glm::dvec3(0.0);
    for (const glm::dvec3& corner : corners) {
        const double projected = glm::dot(radial, corner);
        if (!(projected > 0.0)) {
            // On or across the axis: every longitude, and the pole on that side.
            if (std::hypot(corner.x, corner.y) > _axisTolerance) _fullCircle = true;
            corner.z >= 0.0 ? raiseNorth(kHalfPi) : lowerSouth(-kHalfPi);
            continue;
        }
        const LatitudeCone& cone = corner.z >= 0.0 ? _northCone : _southCone;
        if (cone.excess(projected, std::abs(corner.z)) <= 0.0) continue;
        const double latitude = _ellipsoid.toGeodetic({projected, 0.0, corner.z}).latitude;
        corner.z >= 0.0 ? raiseNorth(latitude) : lowerSouth(latitude);
    }
}

void GeodeticMeshBounds::noteCrossing(const glm::dvec3 (&corners)[3]) noexcept {
    // Behind the axis as seen from the reference, with corners on both sides: relative longitudes wrap within.
    bool behind = false;
    bool left = false;
    bool right = false;
    for (const glm::dvec3& corner : corners) {
        if (std::hypot(corner.x, corner.y) <= _axisTolerance) continue;  // no longitude of its own
        behind |= corner.x * _reference.x + corner.y * _reference.y < 0.0;
        const double side = corner.y * _reference.x - corner.x * _reference.y;
        left |= side >= 0.0;
        right |= side <= 0.0;
    }
    if (behind && left && right) _fullCircle = true;
}

GeodeticMeshBounds::LatitudeCone::LatitudeCone(const Ellipsoid& ellipsoid, double latitude) noexcept
    : _sin(std::sin(latitude)),
      _cos(std::cos(latitude)),
      _offset(ellipsoid.eccentricitySquared() * ellipsoid.primeVerticalRadius(_sin, _cos) * _sin * _cos) {}

void GeodeticMeshBounds::raiseNorth(double latitude) noexcept {
    _latitude.upper = std::max(_latitude.upper, std::min(latitude, kHalfPi));
    _northCone = LatitudeCone(_ellipsoid, _latitude.upper);
}

void GeodeticMeshBounds::lowerSouth(double latitude) noexcept {
    _latitude.lower = std::min(_latitude.lower, std::max(latitude, -kHalfPi));
    _southCone = LatitudeCone(_ellipsoid, -_latitude.lower);
}

GeodeticBin GeodeticMeshBounds::bin() const noexcept {
    if (!(_latitude.lower <= _latitude.upper)) return {};
    // deeper, latitudes leap from one side of the equator or the axis to the other
    if (!(_altitude.lower > -smallestCurvatureRadius(_ellipsoid))) return {};
    if (_fullCircle || !(_relativeLongitude.lower <= _relativeLongitude.upper)) {
        return GeodeticBin(_latitude, {-kPi, kPi}, _altitude);
    }
    return GeodeticBin(_latitude,
                       {_referenceLongitude + _relativeLongitude.lower, _referenceLongitude + _relativeLongitude.upper},
                       _altitude);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../occlusion/SurfaceGrid.h"

#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

// Radians by which angles may be wrong.
constexpr double kRounding = 1e-12;

// The latitude in unit space of the direction of a position (doc/theory/horizon.md, section 2).
double latitudeInUnitSpace(const Ellipsoid& ellipsoid, double latitude, double altitude) {
    const double sine = std::sin(latitude), cosine = std::cos(latitude);
    const double n = ellipsoid.primeVerticalRadius(sine, cosine);
    return std::atan2((n * ellipsoid.squaredRatio() + altitude) * sine / ellipsoid.polarRadius(),
                      (n + altitude) * cosine / ellipsoid.equatorialRadius());
}

// Eastward of the middle of an interval, in radians.
double fromMiddle(const Interval& interval, double longitude) {
    return std::remainder(longitude - interval.middle(), 2.0 * kPi);
}

// Convex, without the sides that a half-plane cuts off: where normal.v >= least.
void clip(std::vector<glm::dvec2>& polygon, const glm::dvec2& normal, double least) {
    std::vector<glm::dvec2> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(normal, a) - least, db = glm::dot(normal, b) - least;
        if (da >= 0.0) inside.push_back(a);
        if ((da < 0.0) != (db < 0.0)) inside.push_back(a + da / (da - db) * (b - a));
    }
    polygon.swap(inside);
}

// Edges of a convex cone, in order about the direction of the eye: it holds the directions in unit space of all lines
// of sight in the frustum from the eye to the occluder.
std::vector<glm::dvec3> edgesOfSight(const Ellipsoid& ellipsoid, const HorizonEyeData& data, const PlaneSet& frustum) {
    const glm::dvec3 toEye(data.x, data.y, data.z);
    const glm::dvec3 right =
        glm::normalize(glm::cross(toEye, std::abs(toEye.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 ahead = glm::cross(toEye, right);
    constexpr int kCorners = 32;
    const double radius = data.sinDip / std::cos(kPi / kCorners) * (1.0 + kRounding);
    std::vector<glm::dvec2> polygon;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * kPi * i / kCorners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    for (std::size_t i = 0; i < frustum.size(); ++i) {
        const Plane plane = frustum[i];
        // in the space in which the occluder is the unit sphere
        const glm::dvec3 normal = data.scale * radii * plane.normal;
        const double slack = kRounding * (glm::length(normal) / data.cosDip + std::abs(plane.offset));
        const double upward = glm::dot(normal, toEye);
        const double ofEye = upward / data.cosDip + plane.offset;
        if (!(ofEye >= -1e3 * slack)) continue;  // the near plane: sight begins outside
        const double least = -plane.offset - std::max(upward, upward * data.cosDip) - 1e3 * slack;
        // the eye's own direction stays inside
        clip(polygon, {glm::dot(normal, right), glm::dot(normal, ahead)}, std::min(least, 0.0));
    }
    std::vector<glm::dvec3> edges;
    for (const glm::dvec2& corner : polygon)
        edges.push_back(glm::normalize(data.cosDip * toEye + corner.x * right + corner.y * ahead));
    return edges;
}

// The largest latitude in a convex cone in unit space, radians.
double northernmost(const std::vector<glm::dvec3>& edges) {
    double north = -kHalfPi;
    bool holdsPole = true;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const glm::dvec3 &a = edges[i], &b = edges[(i + 1) % edges.size()];
        north = std::max(north, std::asin(std::clamp(a.z, -1.0, 1.0)));
        const glm::dvec3 normal = glm::cross(a, b);
        holdsPole = holdsPole && normal.z >= -kRounding;
        // the great circle's own northernmost direction
        const glm::dvec3 summit = glm::dvec3(0, 0, glm::dot(normal, normal)) - normal.z * normal;
        const bool isBetween =
            glm::dot(glm::cross(a, summit), normal) > 0.0 && glm::dot(glm::cross(summit, b), normal) > 0.0;
        if (isBetween) north = std::max(north, std::atan2(glm::length(glm::dvec2(normal)), std::abs(normal.z)));
    }
    return holdsPole ? kHalfPi : north;
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

bool CoveredRegion::holdsHorizon(const HorizonEye& eye, const PlaneSet& frustum) const noexcept {
    const HorizonEyeData& data = eye.data();
    if (_extents.empty() || !(data.cosDip > 0.0)) return false;
    std::vector<glm::dvec3> edges = edgesOfSight(_ellipsoid, data, frustum);
    const double eyeLongitude = std::atan2(data.y, data.x);
    const double aside = fromMiddle(_extents.longitude(), eyeLongitude);
    const double half = 0.5 * _extents.longitude().width() - kRounding;
    const bool isFullCircle = _extents.isFullCircle();
    for (const glm::dvec3& edge : edges) {
        const double turn = std::remainder(std::atan2(edge.y, edge.x) - eyeLongitude, 2.0 * kPi);
        // the cone is in the wedge between two meridians if its edges are
        if (!isFullCircle && !(std::abs(turn) < 0.49 * kPi && std::abs(aside + turn) < half)) return false;
    }
    // altitudes are between the occluder's and the eye's
    const double larger = std::max(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    const double highest = std::max(0.0, data.scale / data.cosDip - 1.0) * larger;
    const double lowest = std::min(0.0, data.scale - 1.0) * larger;
    const auto isSouthOf = [&](double border) {
        if (isFullCircle && border >= kHalfPi) return true;
        return northernmost(edges) + kRounding < std::min(latitudeInUnitSpace(_ellipsoid, border, lowest),
                                                          latitudeInUnitSpace(_ellipsoid, border, highest));
    };
    if (!isSouthOf(_extents.latitude().upper)) return false;
    // mirrored, and in the same order
    for (glm::dvec3& edge : edges) edge.z = -edge.z;
    std::reverse(edges.begin(), edges.end());
    return isSouthOf(-_extents.latitude().lower);
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

}  // namespace osgAnalyticBin::core

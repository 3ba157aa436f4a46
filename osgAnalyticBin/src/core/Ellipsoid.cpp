// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "LocalFrame.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// Near the surface of the earth three or four steps are enough. Near the centres of curvature each step multiplies u by
// up to 1.5; after a hundred steps the remaining error does not change the latitude: doc/theory/derivation.md, section
// 1.
constexpr int kMostSteps = 100;
// Distances below this, in units of the smaller radius, count as zero.
constexpr double kNothing = 1e-100;

// A point of a meridian plane; lengths along the smaller and the larger semi-axis, neither negative.
struct MeridianAxes {
    double smaller, larger;  // semi-axes
    double alongSmaller, alongLarger;
};

// The only root u > 0 of (R / (u + k))^2 + (Z / u)^2 = 1 [E13]. The left side falls and is convex, so that Newton's
// steps from below rise to the root and never pass it.
double footParameter(double r, double z, double k, double guess) noexcept {
    const double least = std::max(z, r - k);
    double u = guess > least ? std::min(guess, std::hypot(r, z)) : least;
    for (int i = 0; i < kMostSteps; ++i) {
        const double along = r / (u + k);
        const double across = z / u;
        const double value = along * along + across * across - 1.0;
        const double slope = 2.0 * (along * along / (u + k) + across * across / u);
        const double next = std::max(least, u + value / slope);
        if (i > 0 && !(next > u)) break;  // the first step may come from above
        u = next;
    }
    return u;
}

struct Direction {
    double alongSmaller, alongLarger;
};

// The outward normal at the nearest point of the ellipse, of any length.
Direction normalAtFoot(const MeridianAxes& p) noexcept {
    const double ratio = p.larger / p.smaller;
    const double k = (ratio - 1.0) * (ratio + 1.0);
    const double r = p.alongLarger / p.smaller * ratio;
    const double z = p.alongSmaller / p.smaller;
    if (!(z > kNothing) && r <= k) {
        // Between the centres of curvature two points, or all of a parallel, are equally near.
        const double share = k > 0.0 ? r / k : 1.0;
        return {ratio * std::sqrt((1.0 - share) * (1.0 + share)), share};
    }
    // The guess is exact on the surface and has an error of second order near it.
    const double x = p.alongLarger / p.larger;
    const double scaled2 = x * x + z * z;
    const double inverse = scaled2 / (x * x / (ratio * ratio) + z * z);
    const double u = footParameter(r, z, k, 1.0 + (std::sqrt(scaled2) - 1.0) * inverse);
    return {z / u, p.alongLarger / p.smaller / (u + k)};
}

bool arePlane(double equatorialRadius, double polarRadius) noexcept {
    return std::isinf(equatorialRadius) && std::isinf(polarRadius);
}

}  // namespace

Ellipsoid::Ellipsoid(double equatorialRadius, double polarRadius) noexcept
    : _a(arePlane(equatorialRadius, polarRadius) ? kMapUnitsInRadian : equatorialRadius),
      _b(arePlane(equatorialRadius, polarRadius) ? kMapUnitsInRadian : polarRadius),
      _squaredRatio((_b / _a) * (_b / _a)),
      _e2((1.0 - _b / _a) * (1.0 + _b / _a)),
      _isPlane(arePlane(equatorialRadius, polarRadius)) {
    assert(std::isfinite(_a) && equatorialRadius > 0.0);
    assert(std::isfinite(_b) && polarRadius > 0.0);
}

Ellipsoid Ellipsoid::plane() noexcept {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity};
}

double Ellipsoid::primeVerticalRadius(double sinLatitude, double cosLatitude) const noexcept {
    return _a / std::sqrt(curvatureTerm(sinLatitude, cosLatitude));
}

double Ellipsoid::meridionalRadius(double sinLatitude, double cosLatitude) const noexcept {
    const double w = curvatureTerm(sinLatitude, cosLatitude);
    return _a * _squaredRatio / (w * std::sqrt(w));
}

glm::dvec3 Ellipsoid::up(double latitude, double longitude) const noexcept {
    if (_isPlane) return {0.0, 0.0, 1.0};
    return LocalFrame(latitude, longitude).up;
}

glm::dvec3 Ellipsoid::toEcef(const Geodetic& position) const noexcept {
    if (_isPlane)
        return {kMapUnitsInRadian * position.longitude, kMapUnitsInRadian * position.latitude, position.altitude};
    const double sinLat = std::sin(position.latitude);
    const double cosLat = std::cos(position.latitude);
    const double n = primeVerticalRadius(sinLat, cosLat);
    const double rho = (n + position.altitude) * cosLat;
    return {rho * std::cos(position.longitude), rho * std::sin(position.longitude),
            (n * _squaredRatio + position.altitude) * sinLat};
}

Geodetic Ellipsoid::toGeodetic(const glm::dvec3& ecef) const noexcept {
    if (_isPlane) return {ecef.y / kMapUnitsInRadian, ecef.x / kMapUnitsInRadian, ecef.z};
    const double rho = std::hypot(ecef.x, ecef.y);
    const double z = std::abs(ecef.z);
    double sine = 0.0;
    double cosine = 0.0;
    if (_b <= _a) {
        const Direction normal = normalAtFoot({_b, _a, z, rho});
        sine = normal.alongSmaller;
        cosine = normal.alongLarger;
    } else {
        const Direction normal = normalAtFoot({_a, _b, rho, z});
        sine = normal.alongLarger;
        cosine = normal.alongSmaller;
    }
    const double length = std::hypot(sine, cosine);
    const double altitude = (rho * cosine + z * sine - std::hypot(_a * cosine, _b * sine)) / length;
    const double longitude = rho > 0.0 ? std::atan2(ecef.y, ecef.x) : 0.0;
    return {std::copysign(std::atan2(sine, cosine), ecef.z), longitude, altitude};
}

double Ellipsoid::support(const glm::dvec3& direction) const noexcept {
    return std::sqrt(_a * _a * (direction.x * direction.x + direction.y * direction.y) +
                     _b * _b * direction.z * direction.z);
}

}  // namespace osgAnalyticBin::core

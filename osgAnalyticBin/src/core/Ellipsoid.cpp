// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Each step gains about three digits on earth-like ellipsoids; the loop ends when nothing changes any more.
constexpr int kMaxLatitudeSteps = 12;

}  // namespace

Ellipsoid::Ellipsoid(double equatorialRadius, double polarRadius) noexcept
    : _a(equatorialRadius),
      _b(polarRadius),
      _e2(1.0 - (polarRadius / equatorialRadius) * (polarRadius / equatorialRadius)) {
    assert(std::isfinite(equatorialRadius) && equatorialRadius > 0.0);
    assert(std::isfinite(polarRadius) && polarRadius > 0.0);
}

double Ellipsoid::primeVerticalRadius(double sinLatitude) const noexcept {
    return _a / std::sqrt(1.0 - _e2 * sinLatitude * sinLatitude);
}

double Ellipsoid::meridionalRadius(double sinLatitude) const noexcept {
    const double w = 1.0 - _e2 * sinLatitude * sinLatitude;
    return _a * (1.0 - _e2) / (w * std::sqrt(w));
}

glm::dvec3 Ellipsoid::toEcef(const Geodetic& position) const noexcept {
    const double sinLat = std::sin(position.latitude);
    const double cosLat = std::cos(position.latitude);
    const double n = primeVerticalRadius(sinLat);
    const double rho = (n + position.altitude) * cosLat;
    return {rho * std::cos(position.longitude), rho * std::sin(position.longitude),
            (n * (1.0 - _e2) + position.altitude) * sinLat};
}

Geodetic Ellipsoid::toGeodetic(const glm::dvec3& ecef) const noexcept {
    const double rho = std::hypot(ecef.x, ecef.y);
    const double ePrime2 = _e2 / (1.0 - _e2);
    // [B85]: tan(latitude) = (z + e'2 b sin3 beta) / (rho - e2 a cos3 beta), tan(beta) = (b/a) tan(latitude)
    double beta = std::atan2(_a * ecef.z, _b * rho);
    double latitude = beta;
    for (int i = 0; i < kMaxLatitudeSteps; ++i) {
        const double s = std::sin(beta);
        const double c = std::cos(beta);
        const double next = std::atan2(ecef.z + ePrime2 * _b * s * s * s, rho - _e2 * _a * c * c * c);
        const bool settled = next == latitude;
        latitude = next;
        if (settled) break;
        beta = std::atan2(_b * std::sin(latitude), _a * std::cos(latitude));
    }
    const double sinLat = std::sin(latitude);
    const double altitude = rho * std::cos(latitude) + ecef.z * sinLat - _a * std::sqrt(1.0 - _e2 * sinLat * sinLat);
    const double longitude = rho > 0.0 ? std::atan2(ecef.y, ecef.x) : 0.0;
    return {latitude, longitude, altitude};
}

double Ellipsoid::support(const glm::dvec3& direction) const noexcept {
    return std::sqrt(_a * _a * (direction.x * direction.x + direction.y * direction.y) +
                     _b * _b * direction.z * direction.z);
}

}  // namespace osgAnalyticBin::core

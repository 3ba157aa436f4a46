// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "../kernels/ScalarTests.h"

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Outward rounding of products and quotients of a few factors; doc/theory/horizon.md, section 5.
constexpr double kUp = 1.0 + 16.0 * kEpsilon;
constexpr double kDown = 1.0 - 16.0 * kEpsilon;

glm::dvec3 toUnitSpace(const Ellipsoid& ellipsoid, const glm::dvec3& v) {
    const double a = ellipsoid.equatorialRadius();
    return {v.x / a, v.y / a, v.z / ellipsoid.polarRadius()};
}

double smallerRadius(const Ellipsoid& e) {
    return std::min(e.equatorialRadius(), e.polarRadius());
}
double largerRadius(const Ellipsoid& e) {
    return std::max(e.equatorialRadius(), e.polarRadius());
}

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The factor of the occluder, rounded down: doc/theory/horizon.md, section 1. Zero when there is none.
double occluderScale(const Ellipsoid& ellipsoid, double depth) {
    if (!(std::abs(depth) <= kDeepestPost * smallerRadius(ellipsoid))) return 0.0;
    const double radius = depth >= 0.0 ? smallerRadius(ellipsoid) : largerRadius(ellipsoid);
    return (1.0 - depth / radius) * kDown;
}

// The latitudes of the bin nearest to the equator and farthest from it.
Interval distancesFromEquator(const Interval& latitude) {
    const double south = std::abs(latitude.lower);
    const double north = std::abs(latitude.upper);
    const bool crossesEquator = latitude.lower <= 0.0 && latitude.upper >= 0.0;
    return {crossesEquator ? 0.0 : std::min(south, north), std::max(south, north)};
}

// Squared radii in unit space of the positions at one altitude, 1 + 2 h N / a2 + h2 (cp2 / a2 + sp2 / b2): both terms
// are monotonous from the equator to a pole.
Interval squaredRadii(const Ellipsoid& ellipsoid, const Interval& latitude, double h) {
    const double a = ellipsoid.equatorialRadius();
    const auto terms = [&](double p) {
        const double sine = std::sin(p);
        const double cosine = std::cos(p);
        const double across = h * cosine / a;
        const double along = h * sine / ellipsoid.polarRadius();
        return glm::dvec2(2.0 * h * ellipsoid.primeVerticalRadius(sine, cosine) / (a * a),
                          across * across + along * along);
    };
    const glm::dvec2 nearest = terms(latitude.lower);
    const glm::dvec2 farthest = terms(latitude.upper);
    const glm::dvec2 low = glm::min(nearest, farthest);
    const glm::dvec2 high = glm::max(nearest, farthest);
    return {(1.0 + low.x + low.y) * kDown, (1.0 + high.x + high.y) * kUp};
}

}  // namespace

HorizonBin::HorizonBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept {
    if (bin.empty()) return;
    if (!(bin.altitude().lower - margin >= -deepestPost(ellipsoid))) return;
    setLongitude(bin);
    setLatitude(ellipsoid, bin);
    setRadius(ellipsoid, bin, margin);
}

void HorizonBin::setLongitude(const GeodeticBin& bin) noexcept {
    const double middle = bin.longitude().middle();
    const double half = std::max(bin.longitude().upper - middle, middle - bin.longitude().lower) * kUp;
    if (bin.isFullCircle() || half >= kPi) return;
    _numbers[row::CosMiddleLongitude] = std::cos(middle);
    _numbers[row::SinMiddleLongitude] = std::sin(middle);
    _numbers[row::CosHalfWidth] = std::cos(half);
    _numbers[row::SinHalfWidth] = std::sin(half);
}

void HorizonBin::setLatitude(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    // tan(psi) = (N (1-e2) + h) sp a / ((N + h) cp b); it is monotonous in the latitude and in the altitude.
    const auto direction = [&](double latitude, double h) {
        const double sine = std::sin(latitude);
        const double cosine = std::max(0.0, std::cos(latitude));
        const double n = ellipsoid.primeVerticalRadius(sine, cosine);
        const double r = (n + h) * cosine / ellipsoid.equatorialRadius();
        const double z = (n * ellipsoid.squaredRatio() + h) * sine / ellipsoid.polarRadius();
        const double length = std::sqrt(r * r + z * z);
        return glm::dvec2(r / length, z / length);
    };
    const auto isNorthOf = [](const glm::dvec2& p, const glm::dvec2& q) { return q.x * p.y - q.y * p.x > 0.0; };
    const glm::dvec2 southLow = direction(bin.latitude().lower, bin.altitude().lower);
    const glm::dvec2 southHigh = direction(bin.latitude().lower, bin.altitude().upper);
    const glm::dvec2 northLow = direction(bin.latitude().upper, bin.altitude().lower);
    const glm::dvec2 northHigh = direction(bin.latitude().upper, bin.altitude().upper);
    const glm::dvec2 south = isNorthOf(southLow, southHigh) ? southHigh : southLow;
    const glm::dvec2 north = isNorthOf(northLow, northHigh) ? northLow : northHigh;
    _numbers[row::CosSouthern] = south.x;
    _numbers[row::SinSouthern] = south.y;
    _numbers[row::CosNorthern] = north.x;
    _numbers[row::SinNorthern] = north.y;
}

void HorizonBin::setRadius(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept {
    const Interval latitude = distancesFromEquator(bin.latitude());
    const double highest = std::sqrt(squaredRadii(ellipsoid, latitude, bin.altitude().upper).upper);
    const double lowest = std::sqrt(squaredRadii(ellipsoid, latitude, bin.altitude().lower).lower);
    const double step = margin / smallerRadius(ellipsoid) * kUp;
    _numbers[row::SinMargin] = step / lowest * kUp;
    if (!(_numbers[row::SinMargin] < 1.0)) return;  // the margin holds the centre
    _numbers[row::CosMargin] = std::sqrt(1.0 - _numbers[row::SinMargin] * _numbers[row::SinMargin]);
    _numbers[row::InverseRadius] = kDown / (highest + step);
}

std::optional<HorizonEye> HorizonEye::fromEye(const Ellipsoid& ellipsoid, double depth,
                                              const glm::dvec3& eyeEcef) noexcept {
    const double scale = occluderScale(ellipsoid, depth);
    if (!(scale > 0.0) || !isFinite(eyeEcef)) return std::nullopt;
    const glm::dvec3 eye = toUnitSpace(ellipsoid, eyeEcef);
    const double length2 = glm::dot(eye, eye);
    if (!(length2 > scale * scale) || !std::isfinite(length2)) return std::nullopt;
    // The eye a little farther out: the dip, and with it what is seen, grows.
    const double ratio = length2 / (scale * scale) * kUp;
    return HorizonEye(eye / std::sqrt(length2), std::sqrt(1.0 / ratio), std::sqrt((ratio - 1.0) / ratio), scale);
}

std::optional<HorizonEye> HorizonEye::fromDirection(const Ellipsoid& ellipsoid, double depth,
                                                    const glm::dvec3& viewDirection,
                                                    const glm::dvec3& nearPointEcef) noexcept {
    const double scale = occluderScale(ellipsoid, depth);
    if (!(scale > 0.0) || !isFinite(viewDirection) || !isFinite(nearPointEcef)) return std::nullopt;
    const double length = glm::length(viewDirection);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    const glm::dvec3 view = viewDirection / length;
    // The occluder reaches from -support to support along the view.
    const double reach = scale * ellipsoid.support(view);
    const double rounding = 16.0 * kEpsilon * (glm::length(nearPointEcef) + reach);
    if (!(glm::dot(view, nearPointEcef) + rounding < -reach)) return std::nullopt;
    // An eye at infinity: its horizon is a right angle away.
    return HorizonEye(glm::normalize(-toUnitSpace(ellipsoid, view)), 0.0, 1.0, scale);
}

HorizonEye::HorizonEye(const glm::dvec3& direction, double cosDip, double sinDip, double scale) noexcept
    : _data{direction.x, direction.y, direction.z, std::sqrt(direction.x * direction.x + direction.y * direction.y),
            cosDip,      sinDip,      scale} {}

bool HorizonEye::hides(const HorizonBin& bin) const noexcept {
    const double* rows = bin.numbers().data();
    return !kernels::scalar::showsAnEnd<double>(rows, _data) && kernels::scalar::isBehindHorizon<double>(rows, _data);
}

// In unit space with the occluder as unit sphere, the eye is at u / c.
double HorizonEye::shareBefore(const Ellipsoid& ellipsoid, const glm::dvec3& centre, double radius) const noexcept {
    const glm::dvec3 direction(_data.x, _data.y, _data.z), at = toUnitSpace(ellipsoid, centre) / _data.scale;
    const double along = glm::dot(at, direction);
    const double rounding = 64.0 * kEpsilon * (1.0 + std::abs(at.x) + std::abs(at.y) + std::abs(at.z));
    const double room = radius / (smallerRadius(ellipsoid) * _data.scale) + rounding;
    // Within the cone that touches the occluder at the horizon. Written so that NaN is in sight.
    const double across = glm::length(at - along * direction);
    if (!(1.0 - _data.cosDip * along - _data.sinDip * across >= room)) return HUGE_VAL;
    const double nearest = glm::length(at - direction / _data.cosDip) * kDown - room;
    return nearest > 0.0 ? _data.sinDip / _data.cosDip * kUp / nearest : HUGE_VAL;
}

}  // namespace osgAnalyticBin::core

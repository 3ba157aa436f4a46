// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/QuadraticBin.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// Rounding of one signed distance, in units of epsilon times the magnitudes that enter; doc/derivation.md, section 7.
constexpr double kRounding = 128.0 * std::numeric_limits<double>::epsilon();
// Normals are of unit length to 1e-9 only; the remainder is meant for exactly one.
constexpr double kNormalTolerance = 1.0 + 1e-9;

// Written so that NaN is Straddling.
Side sideOf(const Interval& range, double slack) {
    if (range.upper + slack < 0.0) return Side::Outside;
    if (range.lower - slack >= 0.0) return Side::Inside;
    return Side::Straddling;
}

// Two values of q: when a plane passes between them, the exact range could not say anything else.
Interval attainedRange(const Quadratic& q) {
    const double u = std::copysign(1.0, q.gradient[0]);
    const double v = std::copysign(1.0, q.gradient[1]);
    const double w = std::copysign(1.0, q.gradient[2]);
    return {q(-u, -v, -w), q(u, v, w)};
}

}  // namespace

QuadraticBin::QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin) noexcept
    : _value(mapping.value(box.center)) {
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    const Hessians hessians = mapping.hessians(box.center);
    const glm::dvec3& e = box.halfSize;
    _first = {jacobian[0] * e.x, jacobian[1] * e.y, jacobian[2] * e.z};
    _second = {hessians.uu * (e.x * e.x), hessians.vv * (e.y * e.y), hessians.ww * (e.z * e.z),
               hessians.uv * (e.x * e.y), hessians.uw * (e.x * e.z), hessians.vw * (e.y * e.z)};
    double magnitude = glm::length(_value);
    for (const glm::dvec3& v : _first) magnitude += glm::length(v);
    for (const glm::dvec3& v : _second) magnitude += glm::length(v);
    // Taylor's theorem with the Lagrange remainder, doc/derivation.md, section 3; rounding, section 7
    _remainder = (mapping.thirdDerivativeBound(box) / 6.0 + margin) * kNormalTolerance + kRounding * magnitude;
    _reach = (farthestCorner() + bulge()) * kNormalTolerance + _remainder;
}

double QuadraticBin::farthestCorner() const noexcept {
    double farthest = 0.0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
        farthest = std::max(farthest, glm::distance(_value, modelPoint(corner)));
    }
    return farthest;
}

double QuadraticBin::uncertainty(const Plane& plane) const noexcept {
    return _remainder + kRounding * std::abs(plane.offset);
}

Quadratic QuadraticBin::distanceModel(const Plane& plane) const noexcept {
    // [JJ] eq. (3)
    Quadratic q;
    q.value = plane.distance(_value);
    for (std::size_t i = 0; i < 3; ++i) q.gradient[i] = glm::dot(plane.normal, _first[i]);
    for (std::size_t i = 0; i < 6; ++i) q.hessian[i] = glm::dot(plane.normal, _second[i]);
    return q;
}

Side QuadraticBin::classify(const Plane& plane) const noexcept {
    // First the sphere about the model: all that most planes need.
    const double distance = plane.distance(_value);
    const double rounding = kRounding * std::abs(plane.offset);
    if (distance - rounding >= _reach) return Side::Inside;
    if (distance + rounding < -_reach) return Side::Outside;

    const Quadratic q = distanceModel(plane);
    const double slack = _remainder + rounding;
    const Side cheap = sideOf(intervalBound(q), slack);
    if (cheap != Side::Straddling || sideOf(attainedRange(q), slack) == Side::Straddling) return cheap;
    return sideOf(exactRange(q), slack);
}

Interval QuadraticBin::distanceRange(const Plane& plane) const noexcept {
    const Interval range = exactRange(distanceModel(plane));
    const double slack = uncertainty(plane);
    return {range.lower - slack, range.upper + slack};
}

double QuadraticBin::bulge() const noexcept {
    // The model less the trilinear interpolant of its corners is the sum of 1/2 H_ii (x_i^2 - 1).
    return 0.5 * (glm::length(_second[0]) + glm::length(_second[1]) + glm::length(_second[2]));
}

glm::dvec3 QuadraticBin::modelPoint(const glm::dvec3& unit) const noexcept {
    const double u = unit.x;
    const double v = unit.y;
    const double w = unit.z;
    return _value + _first[0] * u + _first[1] * v + _first[2] * w +
           0.5 * (_second[0] * (u * u) + _second[1] * (v * v) + _second[2] * (w * w)) + _second[3] * (u * v) +
           _second[4] * (u * w) + _second[5] * (v * w);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/QuadraticBin.h>

#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// Rounding of one signed distance, in units of epsilon times the magnitudes that enter; doc/derivation.md, section 7.
constexpr double kRounding = 128.0 * std::numeric_limits<double>::epsilon();
// Normals are of unit length to 1e-9 only; the remainder is meant for exactly one.
constexpr double kNormalTolerance = 1.0 + 1e-9;

}  // namespace

QuadraticBin::QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin) noexcept
    : _value(mapping.value(box.center)) {
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    const Hessians hessians = mapping.hessians(box.center);
    const glm::dvec3& e = box.halfSize;
    _first = {jacobian[0] * e.x, jacobian[1] * e.y, jacobian[2] * e.z};
    _second = {hessians.uu * (e.x * e.x), hessians.vv * (e.y * e.y), hessians.ww * (e.z * e.z),
               hessians.uv * (e.x * e.y), hessians.uw * (e.x * e.z), hessians.vw * (e.y * e.z)};
    // Taylor's theorem with the Lagrange remainder, doc/derivation.md, section 3
    _remainder = (mapping.thirdDerivativeBound(box) / 6.0 + margin) * kNormalTolerance;
    _magnitude = glm::length(_value);
    for (const glm::dvec3& v : _first) _magnitude += glm::length(v);
    for (const glm::dvec3& v : _second) _magnitude += glm::length(v);
}

double QuadraticBin::uncertainty(const Plane& plane) const noexcept {
    return _remainder + kRounding * (_magnitude + std::abs(plane.offset));
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
    const Quadratic q = distanceModel(plane);
    const double slack = uncertainty(plane);
    const auto sideOf = [slack](const Interval& range) {
        if (range.upper + slack < 0.0) return Side::Outside;
        if (range.lower - slack >= 0.0) return Side::Inside;
        return Side::Straddling;
    };
    const Side cheap = sideOf(intervalBound(q));
    return cheap != Side::Straddling ? cheap : sideOf(exactRange(q));
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

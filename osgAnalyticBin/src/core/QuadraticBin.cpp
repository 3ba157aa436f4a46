// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/ScalarKernels.h"

#include <osgAnalyticBin/core/PlaneSet.h>
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

float roundedUp(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

void assign(double (&to)[3], const glm::dvec3& from) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

}  // namespace

QuadraticBin::QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin) noexcept : _data() {
    assign(_data.sphere.center, mapping.value(box.center));
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    const Hessians hessians = mapping.hessians(box.center);
    const glm::dvec3& e = box.halfSize;
    assign(_data.first[0], jacobian[0] * e.x);
    assign(_data.first[1], jacobian[1] * e.y);
    assign(_data.first[2], jacobian[2] * e.z);
    assign(_data.second[0], hessians.uu * (e.x * e.x));
    assign(_data.second[1], hessians.vv * (e.y * e.y));
    assign(_data.second[2], hessians.ww * (e.z * e.z));
    assign(_data.second[3], hessians.uv * (e.x * e.y));
    assign(_data.second[4], hessians.uw * (e.x * e.z));
    assign(_data.second[5], hessians.vw * (e.y * e.z));
    double magnitude = glm::length(value());
    for (std::size_t i = 0; i < 3; ++i) magnitude += glm::length(first(i));
    for (std::size_t i = 0; i < 6; ++i) magnitude += glm::length(second(i));
    magnitude = std::max(magnitude, mapping.termMagnitude(box));
    // Taylor's theorem with the Lagrange remainder, doc/derivation.md, section 3; rounding, section 7
    _data.remainder = (mapping.thirdDerivativeBound(box) / 6.0 + margin) * kNormalTolerance + kRounding * magnitude;
    _data.sphere.reach = roundedUp((farthestCorner() + bulge()) * kNormalTolerance + _data.remainder);
    const double mixed = glm::length(second(3)) + glm::length(second(4)) + glm::length(second(5));
    _data.sphere.curvature = roundedUp((bulge() + mixed) * kNormalTolerance);
}

glm::dvec3 QuadraticBin::first(std::size_t i) const noexcept {
    return {_data.first[i][0], _data.first[i][1], _data.first[i][2]};
}

glm::dvec3 QuadraticBin::second(std::size_t i) const noexcept {
    return {_data.second[i][0], _data.second[i][1], _data.second[i][2]};
}

double QuadraticBin::farthestCorner() const noexcept {
    double farthest = 0.0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
        farthest = std::max(farthest, glm::distance(value(), modelPoint(corner)));
    }
    return farthest;
}

double QuadraticBin::uncertainty(const Plane& plane) const noexcept {
    return _data.remainder + roundingOf(plane);
}

Quadratic QuadraticBin::distanceModel(const Plane& plane) const noexcept {
    // [JJ] eq. (3)
    Quadratic q;
    q.value = plane.distance(value());
    for (std::size_t i = 0; i < 3; ++i) q.gradient[i] = glm::dot(plane.normal, first(i));
    for (std::size_t i = 0; i < 6; ++i) q.hessian[i] = glm::dot(plane.normal, second(i));
    return q;
}

Side QuadraticBin::classify(const Plane& plane) const noexcept {
    const kernels::Lane lane{plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, roundingOf(plane)};
    kernels::LaneSide side = kernels::sphereSide(_data.sphere, lane);
    if (side == kernels::LaneSide::Open) side = kernels::hullSide(_data, lane);
    if (side == kernels::LaneSide::Open) side = kernels::fullSide(_data, lane);
    switch (side) {
        case kernels::LaneSide::Outside:
            return Side::Outside;
        case kernels::LaneSide::Inside:
            return Side::Inside;
        case kernels::LaneSide::Straddling:
            return Side::Straddling;
        case kernels::LaneSide::Open:
            break;
    }
    return classifyByExactRange(plane);
}

Side QuadraticBin::classifyByExactRange(const Plane& plane) const noexcept {
    // Written so that NaN is Straddling.
    const Interval range = distanceRange(plane);
    if (range.upper < 0.0) return Side::Outside;
    if (range.lower >= 0.0) return Side::Inside;
    return Side::Straddling;
}

Interval QuadraticBin::distanceRange(const Plane& plane) const noexcept {
    const Interval range = exactRange(distanceModel(plane));
    const double slack = uncertainty(plane);
    return {range.lower - slack, range.upper + slack};
}

double QuadraticBin::bulge() const noexcept {
    // The model less the trilinear interpolant of its corners is the sum of 1/2 H_ii (x_i^2 - 1).
    return 0.5 * (glm::length(second(0)) + glm::length(second(1)) + glm::length(second(2)));
}

glm::dvec3 QuadraticBin::modelPoint(const glm::dvec3& unit) const noexcept {
    const double u = unit.x;
    const double v = unit.y;
    const double w = unit.z;
    return value() + first(0) * u + first(1) * v + first(2) * w +
           0.5 * (second(0) * (u * u) + second(1) * (v * v) + second(2) * (w * w)) + second(3) * (u * v) +
           second(4) * (u * w) + second(5) * (v * w);
}

}  // namespace osgAnalyticBin::core

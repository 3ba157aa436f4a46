// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../FloatRounding.h"
#include "../kernels/ScalarTests.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <algorithm>

namespace osgAnalyticBin::core {

namespace {

// Rounding of one signed distance, in units of epsilon times the magnitudes that enter; doc/theory/derivation.md,
// section 7.
constexpr double kRounding = 128.0 * kEpsilon;

}  // namespace

QuadraticBin::QuadraticBin(const AnalyticMapping& mapping, const ParameterBox& box, double margin) noexcept {
    setVector(row::CenterX, mapping.value(box.center));
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    const Hessians hessians = mapping.hessians(box.center);
    const glm::dvec3& e = box.halfSize;
    setVector(row::First, jacobian[0] * e.x);
    setVector(row::First + 3, jacobian[1] * e.y);
    setVector(row::First + 6, jacobian[2] * e.z);
    setVector(row::Second, hessians.uu * (e.x * e.x));
    setVector(row::Second + 3, hessians.vv * (e.y * e.y));
    setVector(row::Second + 6, hessians.ww * (e.z * e.z));
    setVector(row::Second + 9, hessians.uv * (e.x * e.y));
    setVector(row::Second + 12, hessians.uw * (e.x * e.z));
    setVector(row::Second + 15, hessians.vw * (e.y * e.z));
    double magnitude = glm::length(value());
    for (std::size_t i = 0; i < 3; ++i) magnitude += glm::length(first(i));
    for (std::size_t i = 0; i < 6; ++i) magnitude += glm::length(second(i));
    magnitude = std::max(magnitude, mapping.termMagnitude(box));
    // Taylor's theorem with the Lagrange remainder, doc/theory/derivation.md, section 3; rounding, section 7
    _numbers[row::Remainder] = (mapping.remainder(box) + margin) * kNormalTolerance + kRounding * magnitude;
    _numbers[row::Reach] = roundedUp((farthestCorner() + bulge()) * kNormalTolerance + remainder());
    const double mixed = glm::length(second(3)) + glm::length(second(4)) + glm::length(second(5));
    _numbers[row::Curvature] = roundedUp((bulge() + mixed) * kNormalTolerance);
}

QuadraticBin::QuadraticBin(const double* numbers, std::size_t stride) noexcept {
    for (std::size_t i = 0; i < _numbers.size(); ++i) _numbers[i] = numbers[i * stride];
}

void QuadraticBin::setVector(std::size_t i, const glm::dvec3& value) noexcept {
    _numbers[i] = value.x;
    _numbers[i + 1] = value.y;
    _numbers[i + 2] = value.z;
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
    return remainder() + roundingOf(plane);
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
    using namespace kernels::scalar;
    const Sides<double> sides = sidesOf<QuadraticForm>(_numbers.data(), onePlane(plane));
    return sides.open ? classifyByExactRange(plane) : sideOf(sides);
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

glm::dvec3 QuadraticBin::supportPoint(const glm::dvec3& direction) const noexcept {
    glm::dvec3 point = value();
    for (std::size_t i = 0; i < 3; ++i) point += glm::dot(direction, first(i)) < 0.0 ? -first(i) : first(i);
    return point;
}

double QuadraticBin::reach() const noexcept {
    return (glm::length(value()) + _numbers[row::Reach]) * kNormalTolerance;
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

// Not inlined: one plane in a thousand needs it.
kernels::PlaneSides kernels::sidesByExactRange(const double* numbers, std::size_t stride, const PlaneBlock* blocks,
                                               PlaneMask planes) {
    const QuadraticBin bin(numbers, stride);
    PlaneMask outside = 0;
    PlaneMask inside = 0;
    forEachBit(planes, [&](unsigned i) {
        const Side side = bin.classifyByExactRange(planeOf(blocks, i));
        if (side == Side::Outside) outside |= PlaneMask{1} << i;
        if (side == Side::Inside) inside |= PlaneMask{1} << i;
    });
    return PlaneSides::of(outside, inside);
}

}  // namespace osgAnalyticBin::core

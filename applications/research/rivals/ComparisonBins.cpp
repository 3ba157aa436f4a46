// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ComparisonBins.h"

#include <osgAnalyticBin/core/PlaneSet.h>

#include <glm/matrix.hpp>

#include <cmath>

namespace osgAnalyticBin::rivals {

namespace {

core::ParameterBox grown(const core::ParameterBox& box, double factor) {
    return {box.center, box.halfSize * factor};
}

// A plane with a number that is not finite decides nothing.
core::Side sideOf(const core::Plane& plane, double lowest, double highest) {
    if (std::isnan(core::roundingOf(plane))) return core::Side::Straddling;
    if (highest < 0.0) return core::Side::Outside;
    if (lowest >= 0.0) return core::Side::Inside;
    return core::Side::Straddling;
}

// Corner i of the unit cube: bit k of i chooses the sign of coordinate k.
glm::dvec3 unitCorner(std::size_t i) {
    return {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
}

// Where the gradient of q vanishes; NaN where it has no such point.
glm::dvec3 stationaryPoint(const core::Quadratic& q) {
    const auto& h = q.hessian;
    const glm::dmat3 matrix(h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2]);
    return -(glm::inverse(matrix) * glm::dvec3(q.gradient[0], q.gradient[1], q.gradient[2]));
}

bool inUnitBox(const glm::dvec3& x) {
    return std::abs(x.x) <= 1.0 && std::abs(x.y) <= 1.0 && std::abs(x.z) <= 1.0;
}

}  // namespace

PaperBin::PaperBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box, double growth) noexcept
    : _model(mapping, grown(box, growth)) {}

core::Side PaperBin::classify(const core::Plane& plane) const noexcept {
    const core::Quadratic q = _model.distanceModel(plane);
    double lowest = q(-1.0, -1.0, -1.0);
    double highest = lowest;
    const auto take = [&](const glm::dvec3& x) {
        const double value = q(x.x, x.y, x.z);
        lowest = value < lowest ? value : lowest;
        highest = value > highest ? value : highest;
    };
    for (std::size_t i = 1; i < 8; ++i) take(unitCorner(i));
    const glm::dvec3 stationary = stationaryPoint(q);
    if (inUnitBox(stationary)) take(stationary);  // [JJ] section 3: the ninth point
    return sideOf(plane, lowest, highest);
}

CornersBin::CornersBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box) noexcept : _corners() {
    for (std::size_t i = 0; i < 8; ++i) _corners[i] = mapping.value(box.center + unitCorner(i) * box.halfSize);
}

core::Side CornersBin::classify(const core::Plane& plane) const noexcept {
    double lowest = plane.distance(_corners[0]);
    double highest = lowest;
    for (std::size_t i = 1; i < 8; ++i) {
        const double value = plane.distance(_corners[i]);
        lowest = value < lowest ? value : lowest;
        highest = value > highest ? value : highest;
    }
    return sideOf(plane, lowest, highest);
}

}  // namespace osgAnalyticBin::rivals

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TorusSegment.h"

#include <osgAnalyticBin/mappings/FormulaRounding.h>
#include <osgAnalyticBin/mappings/IntervalNumber.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::assembly {

double TorusSegment::remainder(const core::ParameterBox& box) const noexcept {
    const double a = box.halfSize.x;
    const double b = box.halfSize.y;
    const double dr = box.halfSize.z;
    const double r = std::abs(box.center.z) + dr;
    const core::IntervalNumber tube = core::IntervalNumber(box.center.y) + core::IntervalNumber(-b, b);
    const double c = cos(tube).magnitude();
    const double s = sin(tube).magnitude();
    // The distance from the axis, P, with bounds of its differentials; of those of (P, z) together, the tube's circle
    const core::IntervalNumber radius = core::IntervalNumber(box.center.z) + core::IntervalNumber(-dr, dr);
    const double p0 = (radius * cos(tube) + _bendRadius).magnitude();
    const double p1 = std::min(std::hypot(r * b, dr), s * r * b + c * dr);
    const double p2 = std::min(std::hypot(r * b * b, 2.0 * b * dr), c * r * b * b + 2.0 * s * b * dr);
    const double circle3 = std::hypot(r * b * b * b, 3.0 * b * b * dr);
    // doc/theory/mappings.md, section 5: across the bend and along it
    const double across = circle3 + 3.0 * a * a * p1;
    const double along = 3.0 * a * p2 + a * a * a * p0;
    const double angles = (1.0 + a + b) * (1.0 + a + b);
    const double size = glm::length(_frame.origin) + (std::abs(_bendRadius) + 2.0 * r) * angles;
    return core::withRounding(std::hypot(across, along) / 6.0, size);
}

}  // namespace osgAnalyticBin::assembly

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/mappings/CylinderSegment.h>
#include <osgAnalyticBin/mappings/FormulaRounding.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace osgAnalyticBin::core {

Frame frameAboutAxis(const glm::dvec3& origin, const glm::dvec3& axis, const glm::dvec3& zeroDirection) noexcept {
    const glm::dvec3 z = glm::normalize(axis);
    const glm::dvec3 y = glm::normalize(glm::cross(z, zeroDirection));
    return {origin, glm::cross(y, z), y, z};
}

double CylinderSegment::remainder(const ParameterBox& box) const noexcept {
    const double a = box.halfSize.x;
    const double dr = box.halfSize.y;
    const double radius = std::abs(box.center.y) + dr;
    const double height = std::abs(box.center.z) + box.halfSize.z;
    // doc/theory/mappings.md, section 4: along the tangent and along the radius
    const double differential = std::hypot(radius * a * a * a, 3.0 * a * a * dr);
    const double size = glm::length(_frame.origin) + radius * (1.0 + a) * (1.0 + a) + height;
    return withRounding(differential / 6.0, size);
}

}  // namespace osgAnalyticBin::core

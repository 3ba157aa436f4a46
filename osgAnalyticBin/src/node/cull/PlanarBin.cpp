// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PlanarBin.h"

#include "../GlmBridge.h"
#include "../Spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin {

PlanarBin::PlanarBin(const osg::BoundingBoxd& box, const osg::Matrixd& mapToLocal)
    : _center(toGlm(box.center() * mapToLocal)) {
    const osg::Vec3d half = (box._max - box._min) * 0.5;
    for (int i = 0; i < 3; ++i) {
        osg::Vec3d axis;
        axis[i] = half[i];
        _halfAxes[static_cast<std::size_t>(i)] = toGlm(osg::Matrixd::transform3x3(axis, mapToLocal));
    }
    // the four diagonals
    for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
            _radius = std::max(_radius, glm::length(_halfAxes[0] + y * _halfAxes[1] + z * _halfAxes[2]));
        }
    }
    _reach = glm::length(_center) + _radius;
    // Center and axes are rounded on their way here.
    constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();
    double stretch = 0.0;
    double shift = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) stretch += std::abs(mapToLocal(i, j));
        shift += std::abs(mapToLocal(3, i));
    }
    _rounding = kRounding * (_reach + stretch * (box.center().length() + half.length()) + shift);
}

glm::dvec3 PlanarBin::supportPoint(const glm::dvec3& direction) const noexcept {
    glm::dvec3 point = _center;
    for (const glm::dvec3& axis : _halfAxes) point += glm::dot(direction, axis) < 0.0 ? -axis : axis;
    return point;
}

bool PlanarBin::holds(const osg::Vec3d& point) const noexcept {
    constexpr double kTolerance = 1e-6;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 across = glm::cross(_halfAxes[(i + 1) % 3], _halfAxes[(i + 2) % 3]);
        const double away = std::abs(glm::dot(across, toGlm(point) - _center));
        const double room = std::abs(glm::dot(across, _halfAxes[i]));
        // written so that NaN is not held
        if (!(away <= room + (kTolerance * _radius + _rounding) * glm::length(across))) return false;
    }
    return true;
}

osg::BoundingSphere PlanarBin::boundingSphere() const {
    return roundedOutward(toOsg(_center), _radius + _rounding);
}

}  // namespace osgAnalyticBin

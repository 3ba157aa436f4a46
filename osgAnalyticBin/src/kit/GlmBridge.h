// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/CoordinateSystemNode>
#include <osg/Plane>
#include <osg/Vec3d>

#include <cmath>
#include <limits>

namespace osgAnalyticBin {

[[nodiscard]] inline glm::dvec3 toGlm(const osg::Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}

[[nodiscard]] inline osg::Vec3d toOsg(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// A plane that OSG could not normalise, or that is not finite, becomes a plane of NaN, which decides nothing. Singular
/// matrices produce such planes.
[[nodiscard]] inline core::Plane toCore(const osg::Plane& plane) {
    const double length2 = plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2];
    const bool isRight = std::abs(length2 - 1.0) <= 1e-9 && std::isfinite(plane[3]);
    if (!isRight) return {glm::dvec3(std::numeric_limits<double>::quiet_NaN()), 0.0};
    return {{plane[0], plane[1], plane[2]}, plane[3]};
}

[[nodiscard]] inline core::Ellipsoid toCore(const osg::EllipsoidModel& ellipsoid) {
    return core::Ellipsoid(ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar());
}

}  // namespace osgAnalyticBin

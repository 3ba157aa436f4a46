// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Plane>
#include <osg/Vec3d>

namespace osgAnalyticBin {

[[nodiscard]] inline glm::dvec3 toGlm(const osg::Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}

[[nodiscard]] inline osg::Vec3d toOsg(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

[[nodiscard]] inline core::Plane toCore(const osg::Plane& plane) {
    return {{plane[0], plane[1], plane[2]}, plane[3]};
}

[[nodiscard]] inline core::Ellipsoid toCore(const osg::EllipsoidModel& ellipsoid) {
    return core::Ellipsoid(ellipsoid.getRadiusEquator(), ellipsoid.getRadiusPolar());
}

/// WGS 84 as OSG has it.
[[nodiscard]] inline core::Ellipsoid defaultEllipsoid() {
    return toCore(*osg::ref_ptr<osg::EllipsoidModel>(new osg::EllipsoidModel));
}

}  // namespace osgAnalyticBin

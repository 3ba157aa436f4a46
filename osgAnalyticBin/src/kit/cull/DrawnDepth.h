// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingBox>
#include <osg/Matrixd>

#include <algorithm>

namespace osgAnalyticBin {

/// The distance from the plane of the eye to the farthest corner of a box, as osgUtil::CullVisitor computes its far
/// plane. `toEye`: from the box's frame to eye space. Requires: a valid box.
[[nodiscard]] inline double farthestDepth(const osg::BoundingBox& box, const osg::Matrixd& toEye) {
    double depth = -toEye(3, 2);
    for (int i = 0; i < 3; ++i) depth += std::max(-toEye(i, 2) * box._min[i], -toEye(i, 2) * box._max[i]);
    return depth;
}

}  // namespace osgAnalyticBin

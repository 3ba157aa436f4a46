// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Array>
#include <osg/Geometry>
#include <osg/Vec4>

#include <vector>

namespace osgAnalyticBin::viewer {

/// Triangles or lines of one colour between vertices.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                                      const std::vector<unsigned int>& indices,
                                                      const osg::Vec4& colour);

}  // namespace osgAnalyticBin::viewer

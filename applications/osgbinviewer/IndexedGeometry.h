// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Array>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Vec4>

#include <initializer_list>
#include <vector>

namespace osgAnalyticBin::viewer {

/// Triangles, seen from both sides, or lines of one colour between vertices: blended, in a render bin of the overlay.
/// They do not change the depth buffer.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                                      const std::vector<unsigned int>& indices, const osg::Vec4& colour,
                                                      int renderBin);

/// Parts of a drawing, where a matrix puts them.
[[nodiscard]] osg::ref_ptr<osg::Node> placed(const osg::Matrixd& toWorld,
                                             std::initializer_list<osg::ref_ptr<osg::Geometry>> parts);

}  // namespace osgAnalyticBin::viewer

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>

#include <osg/Geometry>

namespace osgAnalyticBin::assembly {

/// Cells of a mesh in each parameter.
using Steps = glm::ivec3;

/// The six faces of a mapped box as triangles, with normals that point out of it. Vertices are mapped positions of the
/// box, rounded to float.
[[nodiscard]] osg::ref_ptr<osg::Geometry> meshOf(const core::AnalyticMapping& mapping, const core::ParameterBox& box,
                                                 const Steps& steps);

/// How far the rounding to float moves a vertex at most.
[[nodiscard]] double floatRounding(const osg::Geometry& mesh);

}  // namespace osgAnalyticBin::assembly

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Program>

namespace osgAnalyticBin {

/// Whether a program may leave out parts of the triangles, draw them elsewhere than their vertices say, or at other
/// depths, by the text of its shaders. Where that does not tell it is doubted. Returns: false where fragment shaders
/// neither discard nor write depths, and vertex shaders transform each vertex by the model view and projection matrix,
/// or where setDrawsTriangles() was called.
/// Cost: that of comparing the text with what this thread read last.
[[nodiscard]] bool mayAlterSurface(const osg::Program& program);

}  // namespace osgAnalyticBin

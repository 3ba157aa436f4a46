// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Camera>
#include <osg/FrameStamp>

namespace osgAnalyticBin::bench {

/// Makes a camera's scene repeat, without a test, what bins decide at the camera's present view. One cull traversal is
/// recorded; then bins and cluster callbacks are taken off, and each group accepts only the children that the traversal
/// went into or drew, whose spheres and boxes are not tested either. So the next cull traversals cost what OSG takes
/// for the tiles kept, and nothing for the tests. Requires: a scene with bins, all files loaded. The scene
/// serves this view alone; read it again for another.
void replayVerdicts(osg::Camera& camera, osg::FrameStamp& frameStamp);

}  // namespace osgAnalyticBin::bench

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/viewer/Export.h>

namespace osg {
class Camera;
}
namespace osgViewer {
class ViewerBase;
}

namespace osgAnalyticBin {

/// The verdicts of bins in one frame, summed over all cull traversals of a viewer's camera (stereo has two). Call it
/// between frames, when no cull traversal runs. `frame`: the number of the frame.
/// Returns: sums; zeros where nothing was tested in that frame, and for cameras that no viewer draws.
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT BinCounts binCounts(osg::Camera& camera, unsigned int frame);

/// The same over all cameras of a viewer, for the last frame that was culled: a viewer that is told to end culls none
/// any more.
[[nodiscard]] OSGANALYTICBINVIEWER_EXPORT BinCounts binCounts(osgViewer::ViewerBase& viewer);

}  // namespace osgAnalyticBin

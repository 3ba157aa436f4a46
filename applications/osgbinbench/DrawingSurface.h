// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FrameCapture.h"

#include <osg/GraphicsContext>
#include <osg/Image>
#include <osgViewer/Viewer>

namespace osgAnalyticBin::bench {

/// An invisible drawing surface without multisampling.
/// Throws: Failure when there is no display, or none that OpenGL can draw on.
[[nodiscard]] osg::ref_ptr<osg::GraphicsContext> makeDrawingSurface(int width, int height);

/// Gives the viewer's camera a drawing surface of its own, and makes pictures comparable to the pixel: near and far
/// stay as they are set, nothing small is culled, drawing goes in traversal order. Keys and mouse do nothing.
void prepareViewer(osgViewer::Viewer& viewer, int width, int height);

/// Draws frames until the picture of one that begins now is there.
/// Returns: nullptr when `mostFrames` were not enough.
[[nodiscard]] osg::ref_ptr<osg::Image> drawPicture(osgViewer::Viewer& viewer, flight::FrameCapture& capture,
                                                   int mostFrames = 20);

}  // namespace osgAnalyticBin::bench

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FrameCapture.h"

#include <osg/Image>
#include <osgViewer/Viewer>

namespace osgAnalyticBin::bench {

/// The one viewer of the process: draws now this scene, now that one, on an invisible surface.
/// Pictures are comparable to the pixel: near and far stay as they are set, nothing small is culled, nothing is
/// smoothed, drawing goes in traversal order, and textures are not filtered anisotropically.
class BenchViewer {
public:
    /// Throws: Failure when there is no display, or none that OpenGL can draw on.
    BenchViewer(int width, int height, osgViewer::ViewerBase::ThreadingModel threading);
    ~BenchViewer();

    BenchViewer(const BenchViewer&) = delete;
    BenchViewer& operator=(const BenchViewer&) = delete;

    /// Draws this scene from now on, with the pager that it has already, if any.
    void show(osg::Node& root, osg::CullSettings::CullingMode culling);

    void setView(const osg::Matrixd& view, const osg::Matrixd& projection);

    /// Draws frames until the picture of one that begins now is there.
    /// Throws: Failure when it does not come.
    [[nodiscard]] osg::ref_ptr<osg::Image> picture();

    /// Ends all drawing, so that the scene may be looked at by others; the next frame starts it again.
    void rest();

private:
    void drawFrame();

    osgViewer::Viewer _viewer;
    osg::ref_ptr<flight::FrameCapture> _capture;
};

}  // namespace osgAnalyticBin::bench

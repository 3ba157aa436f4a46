// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DrawingSurface.h"

#include "Failure.h"

namespace osgAnalyticBin::bench {

osg::ref_ptr<osg::GraphicsContext> makeDrawingSurface(int width, int height) {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits =
        new osg::GraphicsContext::Traits(osg::DisplaySettings::instance());
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = width;
    traits->height = height;
    traits->pbuffer = true;
    traits->doubleBuffer = true;
    traits->depth = 24;
    traits->samples = 0;
    traits->sampleBuffers = 0;
    traits->vsync = false;
    osg::ref_ptr<osg::GraphicsContext> surface = osg::GraphicsContext::createGraphicsContext(traits);
    if (!surface) throw Failure("no display to draw on; set DISPLAY or run under \"xvfb-run -a\"");
    return surface;
}

void prepareViewer(osgViewer::Viewer& viewer, int width, int height) {
    const osg::ref_ptr<osg::GraphicsContext> surface = makeDrawingSurface(width, height);
    osg::Camera& camera = *viewer.getCamera();
    camera.setGraphicsContext(surface);
    camera.setViewport(new osg::Viewport(0, 0, width, height));
    const GLenum buffer = surface->getTraits()->doubleBuffer ? GL_BACK : GL_FRONT;
    camera.setDrawBuffer(buffer);
    camera.setReadBuffer(buffer);
    camera.setProjectionResizePolicy(osg::Camera::FIXED);
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
    camera.setLODScale(1.0F);
    osg::StateSet& state = *camera.getOrCreateStateSet();
    state.setMode(GL_MULTISAMPLE_ARB, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state.setMode(GL_DITHER, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state.setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
    viewer.setCameraManipulator(nullptr);
    viewer.setKeyEventSetsDone(0);
    viewer.setQuitEventSetsDone(false);
}

osg::ref_ptr<osg::Image> drawPicture(osgViewer::Viewer& viewer, flight::FrameCapture& capture, int mostFrames) {
    capture.request(viewer.getFrameStamp()->getFrameNumber() + 1);
    for (int i = 0; i < mostFrames; ++i) {
        viewer.frame();
        if (osg::ref_ptr<osg::Image> picture = capture.take()) return picture;
    }
    return nullptr;
}

}  // namespace osgAnalyticBin::bench

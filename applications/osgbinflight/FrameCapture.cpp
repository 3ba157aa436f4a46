// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FrameCapture.h"

#include <osg/GraphicsContext>
#include <osg/Multisample>
#include <osg/RenderInfo>

namespace osgAnalyticBin::flight {

namespace {

osg::ref_ptr<osg::Image> readPicture(const osg::Camera& camera) {
    const osg::Viewport& viewport = *camera.getViewport();
    const osg::GraphicsContext* const context = camera.getGraphicsContext();
    const bool doubleBuffered = !context || !context->getTraits() || context->getTraits()->doubleBuffer;
    glReadBuffer(doubleBuffered ? GL_BACK : GL_FRONT);
    const osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->readPixels(static_cast<int>(viewport.x()), static_cast<int>(viewport.y()),
                        static_cast<int>(viewport.width()), static_cast<int>(viewport.height()), GL_RGB,
                        GL_UNSIGNED_BYTE);
    return picture;
}

}  // namespace

void makeComparable(osg::Camera& camera) {
    camera.setLODScale(1.0F);
    camera.setProjectionResizePolicy(osg::Camera::FIXED);
    osg::StateSet& state = *camera.getOrCreateStateSet();
    state.setMode(GL_MULTISAMPLE_ARB, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state.setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
}

void FrameCapture::request(unsigned int frameNumber) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _frameNumber = frameNumber;
    _picture = nullptr;
    _requested = true;
}

osg::ref_ptr<osg::Image> FrameCapture::take() {
    const std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::Image> picture;
    picture.swap(_picture);
    return picture;
}

void FrameCapture::operator()(osg::RenderInfo& renderInfo) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const osg::FrameStamp* const frameStamp = renderInfo.getState()->getFrameStamp();
    const osg::Camera* const camera = renderInfo.getCurrentCamera();
    if (!_requested || !frameStamp || !camera || !camera->getViewport()) return;
    if (frameStamp->getFrameNumber() < _frameNumber) return;
    _picture = readPicture(*camera);
    _requested = false;
}

}  // namespace osgAnalyticBin::flight

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Camera>
#include <osg/GLExtensions>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/State>

#include <mutex>

namespace osgAnalyticBin::flight {

/// Makes pictures of a camera comparable to the pixel: nothing is smoothed, and drawing goes in traversal order
/// (coplanar surfaces then come out alike).
void makeComparable(osg::Camera& camera);

/// A final draw callback that reads the picture of one frame back, right before the buffers are swapped.
/// Threads: the camera draws in a thread of its own, perhaps while the next frame is prepared; therefore a picture is
/// asked for by frame number, and fetched in a later frame.
class FrameCapture : public osg::Camera::DrawCallback {
public:
    /// Asks for the picture of the given frame.
    void request(unsigned int frameNumber);

    /// Returns: the picture asked for; nullptr as long as it is not drawn.
    [[nodiscard]] osg::ref_ptr<osg::Image> take();

    void operator()(osg::RenderInfo& renderInfo) const override;

protected:
    ~FrameCapture() override = default;

private:
    mutable std::mutex _mutex;
    mutable bool _requested = false;
    mutable osg::ref_ptr<osg::Image> _picture;
    unsigned int _frameNumber = 0;
};

/// A realize operation for pictures: Mesa's software renderer (22.3) never comes back from filtering the terrain's
/// textures anisotropically where they are seen at a grazing angle.
class WithoutAnisotropy : public osg::Operation {
public:
    WithoutAnisotropy() : osg::Operation("without anisotropic filtering", false) {}

    void operator()(osg::Object* object) override {
        const auto* const surface = dynamic_cast<osg::GraphicsContext*>(object);
        if (!surface || !surface->getState()) return;
        osg::GLExtensions::Get(surface->getState()->getContextID(), true)->isTextureFilterAnisotropicSupported = false;
    }
};

}  // namespace osgAnalyticBin::flight

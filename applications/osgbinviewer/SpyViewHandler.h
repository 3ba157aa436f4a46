// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"

#include <osg/GraphicsContext>
#include <osg/Group>

namespace osgAnalyticBin::viewer {

/// Key `y`: opens or closes a second window that shows the view's camera from the side: what that camera draws,
/// and its frustum. Drag in the window to orbit, scroll to zoom. One handler for each view.
class SpyViewHandler : public KeyHandler {
public:
    SpyViewHandler();

    /// Opens or closes the window, as the key does. Between frames only; a viewer that draws in threads pauses them.
    void setOpen(osgViewer::View& view, bool open);
    /// Whether the window is there.
    [[nodiscard]] bool isOpen() const { return _camera.valid(); }

    /// The window's camera, a slave of the view's; null while it is closed.
    [[nodiscard]] osg::Camera* camera() const { return _camera.get(); }

    /// Where the window looks from: radians round the local vertical from behind the view's camera, radians above its
    /// horizon, and the distance as a multiple of that from the camera to what it looks at.
    void setOrbit(double azimuth, double elevation, double distance);

protected:
    ~SpyViewHandler() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;
    bool handleOther(const osgGA::GUIEventAdapter& event, osgViewer::View& view) override;

private:
    class Placement;

    void open(osgViewer::View& view);
    void close(osgViewer::View& view);
    bool orbit(const osgGA::GUIEventAdapter& event);

    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<osg::Group> _frustum;
    const osg::ref_ptr<Placement> _placement;
    float _lastX = 0.0F;
    float _lastY = 0.0F;
};

}  // namespace osgAnalyticBin::viewer

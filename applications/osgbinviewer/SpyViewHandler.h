// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/GraphicsContext>
#include <osg/Group>
#include <osgGA/GUIEventHandler>

namespace osg {
class Camera;
}
namespace osgViewer {
class View;
}

namespace osgAnalyticBin::viewer {

/// Key `y`: opens or closes a second window that shows the view's camera from the side: what that camera draws,
/// and its frustum. Drag in the window to orbit, scroll to zoom. One handler for each view.
class SpyViewHandler : public osgGA::GUIEventHandler {
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

    /// Handles the key, and the mouse in the second window. Returns: whether the event was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~SpyViewHandler() override;

private:
    class Placement;

    void open(osgViewer::View& view);
    void close(osgViewer::View& view);
    void drawFrustum(osgViewer::View& view);
    bool orbit(const osgGA::GUIEventAdapter& event);

    static constexpr int kKey = 'y';
    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<osg::Group> _frustum;
    const osg::ref_ptr<Placement> _placement;
    float _lastX = 0.0F;
    float _lastY = 0.0F;
};

}  // namespace osgAnalyticBin::viewer

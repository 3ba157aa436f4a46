// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"
#include "ViewTools.h"

#include <osg/Notify>
#include <osgViewer/ViewerBase>

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kFovDeg = 45.0;
constexpr double kNear = 1.0;
constexpr double kFar = 1e8;
const double kHighest = osg::DegreesToRadians(89.0);

// Pauses the viewer's threads, so that windows may come and go.
class ThreadPause {
public:
    explicit ThreadPause(osgViewer::ViewerBase& viewer) : _viewer(viewer), _wasRunning(viewer.areThreadsRunning()) {
        if (_wasRunning) _viewer.stopThreading();
    }
    ~ThreadPause() {
        if (_wasRunning) _viewer.startThreading();
    }
    ThreadPause(const ThreadPause&) = delete;
    ThreadPause& operator=(const ThreadPause&) = delete;

private:
    osgViewer::ViewerBase& _viewer;
    const bool _wasRunning;
};

// Textures and meshes hold an array with one element per window, whose size follows OSG's settings when they are made.
// Draw threads enlarge it when needed, but two at once would corrupt it. So all that is read from now on gets one
// element more than there are windows.
void leaveRoomForAWindow() {
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    const unsigned int wanted = osg::GraphicsContext::getMaxContextID() + 2;
    if (settings.getMaxNumberOfGraphicsContexts() < wanted) settings.setMaxNumberOfGraphicsContexts(wanted);
}

// Gives an element per window to all that a view draws, its cameras' overlays and their fonts included.
void makeRoomForWindows(osgViewer::View& view) {
    const unsigned int windows = osg::GraphicsContext::getMaxContextID() + 1;
    view.getCamera()->resizeGLObjectBuffers(windows);
    for (unsigned int i = 0; i < view.getNumSlaves(); ++i) view.getSlave(i)._camera->resizeGLObjectBuffers(windows);
    view.getSceneData()->resizeGLObjectBuffers(windows);
}

// A window as large as the camera's, beside it.
osg::ref_ptr<osg::GraphicsContext> makeWindow(const osg::GraphicsContext& beside) {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits(*beside.getTraits());
    traits->x += traits->width;
    traits->windowName = "what the camera culls";
    traits->inheritedWindowData = nullptr;
    traits->sharedContext = nullptr;
    traits->vsync = false;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

osg::ref_ptr<osg::Camera> makeCamera(osg::GraphicsContext& window, const osg::Camera& beside) {
    const osg::GraphicsContext::Traits& traits = *window.getTraits();
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setCullSettings(beside);
    camera->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
    camera->setGraphicsContext(&window);
    camera->setViewport(new osg::Viewport(0, 0, traits.width, traits.height));
    camera->setDrawBuffer(traits.doubleBuffer ? GL_BACK : GL_FRONT);
    camera->setReadBuffer(traits.doubleBuffer ? GL_BACK : GL_FRONT);
    camera->setClearColor(beside.getClearColor());
    camera->setProjectionMatrixAsPerspective(kFovDeg, double(traits.width) / traits.height, kNear, kFar);
    camera->setAllowEventFocus(false);
    return camera;
}

}  // namespace

// Keeps the window's camera beside the culling view that it looks at.
class SpyViewHandler::Placement : public osg::View::Slave::UpdateSlaveCallback {
public:
    void updateSlave(osg::View& view, osg::View::Slave& slave) override {
        const osgViewer::View* shown = dynamic_cast<osgViewer::View*>(&view);
        osg::ref_ptr<osg::Camera> watched;
        if (!shown || !shown->getSceneData() || !camera.lock(watched)) return;
        slave._camera->setViewMatrix(viewOf(*watched, *const_cast<osg::Node*>(shown->getSceneData())));
        CameraCulling::of(*slave._camera).updateFollowed();
    }

    osg::observer_ptr<osg::Camera> camera;
    std::optional<flight::Globe> globe;
    double azimuth = osg::DegreesToRadians(60.0);
    double elevation = osg::DegreesToRadians(35.0);
    double distance = 2.4;

private:
    [[nodiscard]] osg::Matrixd viewOf(osg::Camera& watched, const osg::Node& scene) const {
        const osg::Matrixd toWorld = osg::Matrixd::inverse(CameraCulling::cullingView(watched).view);
        const osg::Vec3d eye = osg::Vec3d() * toWorld;
        const osg::Vec3d sight = osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, -1.0), toWorld);
        const osg::Vec3d target = targetOf(eye, sight, scene);
        const osg::Vec3d center = eye * 0.4 + target * 0.6;
        osg::Vec3d up = globe ? globe->vertical(globe->geodetic(center)) : osg::Vec3d(0.0, 0.0, 1.0);
        osg::Vec3d forward = sight - up * (sight * up);
        if (forward.normalize() < 1e-3) {
            forward = osg::Matrixd::transform3x3(osg::Vec3d(0.0, 1.0, 0.0), toWorld);
            forward -= up * (forward * up);
            forward.normalize();
        }
        const osg::Vec3d side = forward ^ up;
        const osg::Vec3d level = -forward * std::cos(azimuth) + side * std::sin(azimuth);
        const osg::Vec3d away = level * std::cos(elevation) + up * std::sin(elevation);
        return osg::Matrixd::lookAt(center + away * (distance * (target - eye).length()), center, up);
    }

    // What the camera looks at: on the globe, else as far as its horizon.
    [[nodiscard]] osg::Vec3d targetOf(const osg::Vec3d& eye, const osg::Vec3d& sight, const osg::Node& scene) const {
        if (!globe) return eye + sight * std::max(1.0, (osg::Vec3d(scene.getBound().center()) - eye).length());
        if (const auto ground = globe->intersection(eye, sight)) return *ground;
        const double radius = globe->ellipsoid->getRadiusEquator();
        const double height = std::max(globe->geodetic(eye).altitude, 1.0);
        return eye + sight * std::sqrt(height * (2.0 * radius + height));
    }
};

SpyViewHandler::SpyViewHandler() : _placement(new Placement) {
    addKey('y', "Second window that shows from aside what the camera draws.",
           [this](osgViewer::View& view) { setOpen(view, !isOpen()); });
}
SpyViewHandler::~SpyViewHandler() = default;

void SpyViewHandler::setOrbit(double azimuth, double elevation, double distance) {
    _placement->azimuth = azimuth;
    _placement->elevation = elevation;
    _placement->distance = distance;
}

void SpyViewHandler::setOpen(osgViewer::View& view, bool isOpenWanted) {
    if (isOpenWanted == isOpen()) return;
    isOpenWanted ? open(view) : close(view);
}

void SpyViewHandler::open(osgViewer::View& view) {
    const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(view);
    if (cameras.empty()) return;
    osg::Camera& watched = *cameras.front();
    const ThreadPause pause(*view.getViewerBase());
    const osg::ref_ptr<osg::GraphicsContext> window = makeWindow(*watched.getGraphicsContext());
    if (!window || !window->realize()) {
        OSG_WARN << "SpyViewHandler: no second window could be opened on this display." << std::endl;
        return;
    }
    _camera = makeCamera(*window, watched);
    _placement->camera = &watched;
    _placement->globe = flight::findGlobe(*view.getSceneData());
    CameraCulling& culling = CameraCulling::of(*_camera);
    culling.follow(&watched);
    culling.updateFollowed();
    _frustum = new osg::Group;
    culling.overlay().addChild(_frustum);
    // a new slave's renderer sets the master's state to OSG's defaults: lighting switched off by a key would come back
    osg::StateSet& state = *view.getCamera()->getOrCreateStateSet();
    const osg::ref_ptr<osg::StateSet> before = new osg::StateSet(state);
    view.addSlave(_camera, osg::Matrixd(), osg::Matrixd(), true);
    state.setModeList(before->getModeList());
    state.setAttributeList(before->getAttributeList());
    view.getSlave(view.getNumSlaves() - 1)._updateSlaveCallback = _placement;
    makeRoomForWindows(view);
}

void SpyViewHandler::close(osgViewer::View& view) {
    const ThreadPause pause(*view.getViewerBase());
    // while the camera is still there, whose scene has something in the window
    const osg::ref_ptr<osg::GraphicsContext> window = _camera->getGraphicsContext();
    if (window) window->close();
    const unsigned int slave = view.findSlaveIndexForCamera(_camera);
    if (slave < view.getNumSlaves()) view.removeSlave(slave);
    _camera->setGraphicsContext(nullptr);
    _camera = nullptr;
    _frustum = nullptr;
}

void SpyViewHandler::draw(osgViewer::View& view, osg::Camera&) {
    leaveRoomForAWindow();
    osg::ref_ptr<osg::Camera> watched;
    if (!_frustum || !_placement->camera.lock(watched)) return;
    _frustum->removeChildren(0, _frustum->getNumChildren());
    const CameraCulling* culling = CameraCulling::find(*watched);
    // a frozen camera draws its frustum itself, and the spy draws what it draws
    if (culling && culling->isFrozen()) return;
    _frustum->addChild(
        makeFrustum(CameraCulling::cullingView(*watched), _placement->globe, view.getSceneData()->getBound().radius()));
    computeBounds(*_frustum);
}

bool SpyViewHandler::orbit(const osgGA::GUIEventAdapter& event) {
    constexpr double kWheelStep = 1.15;
    switch (event.getEventType()) {
        case osgGA::GUIEventAdapter::DRAG:
            _placement->azimuth -= double(event.getX() - _lastX) * 0.01;
            _placement->elevation -= double(event.getY() - _lastY) * 0.01;
            _placement->elevation = std::clamp(_placement->elevation, -kHighest, kHighest);
            break;
        case osgGA::GUIEventAdapter::SCROLL:
            if (event.getScrollingMotion() == osgGA::GUIEventAdapter::SCROLL_UP) _placement->distance /= kWheelStep;
            if (event.getScrollingMotion() == osgGA::GUIEventAdapter::SCROLL_DOWN) _placement->distance *= kWheelStep;
            break;
        case osgGA::GUIEventAdapter::PUSH:
        case osgGA::GUIEventAdapter::RELEASE:
        case osgGA::GUIEventAdapter::MOVE:
            break;
        default:
            return false;
    }
    _lastX = event.getX();
    _lastY = event.getY();
    return true;
}

bool SpyViewHandler::handleOther(const osgGA::GUIEventAdapter& event, osgViewer::View& view) {
    if (!isOpen() || event.getGraphicsContext() != _camera->getGraphicsContext()) return false;
    if (event.getEventType() != osgGA::GUIEventAdapter::CLOSE_WINDOW) return orbit(event);
    close(view);
    return true;
}

}  // namespace osgAnalyticBin::viewer

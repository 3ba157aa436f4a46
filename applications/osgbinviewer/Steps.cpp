// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"
#include "Failure.h"
#include "FrameCapture.h"
#include "Handlers.h"
#include "ViewTools.h"

#include <osg/Timer>
#include <osgDB/DatabasePager>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kLongestWait = 120.0;  // seconds
constexpr int kIdleFrames = 5;

// The camera of a window that draws last.
osg::Camera& lastCamera(osg::GraphicsContext& window) {
    osg::Camera* last = nullptr;
    for (osg::Camera* camera : window.getCameras()) {
        const bool isLater = !last || last->getRenderOrder() < camera->getRenderOrder() ||
                             (last->getRenderOrder() == camera->getRenderOrder() &&
                              last->getRenderOrderNum() <= camera->getRenderOrderNum());
        if (camera->getNodeMask() != 0 && isLater) last = camera;
    }
    if (!last) throw std::runtime_error("--steps: a window without a camera");
    return *last;
}

class Steps {
public:
    Steps(osgViewer::Viewer& viewer, const std::vector<flight::CameraPose>& poses) : _viewer(viewer), _poses(poses) {}

    void run(const std::string& text) {
        std::istringstream steps(text);
        for (std::string step; steps >> step;) {
            const auto equals = step.find('=');
            if (equals == std::string::npos) throw support::UsageError("--steps: \"" + step + "\" is not VERB=VALUE");
            runOne(step.substr(0, equals), step.substr(equals + 1));
        }
    }

private:
    void runOne(const std::string& verb, const std::string& value) {
        if (verb == "at") return standAt(value);
        if (verb == "press") return press(value);
        if (verb == "frames") return drawFrames(std::atoi(value.c_str()));
        if (verb == "picture") return takePicture(value);
        throw support::UsageError("--steps: \"" + verb + "\" is none of at, press, frames, picture");
    }

    void standAt(const std::string& name) {
        osg::Camera& camera = *_viewer.getCamera();
        if (name == "home") {
            const HomeView home = homeViewOf(*_viewer.getSceneData(), camera.getProjectionMatrix());
            camera.setViewMatrixAsLookAt(home.eye, home.center, home.up);
            return drawUntilIdle();
        }
        const auto pose = std::find_if(_poses.begin(), _poses.end(),
                                       [&](const flight::CameraPose& each) { return each.name == name; });
        if (pose == _poses.end()) throw support::UsageError("--steps: no pose \"" + name + "\" in the file of --poses");
        const flight::Globe globe = flight::globeOf(*_viewer.getSceneData());
        camera.setViewMatrix(flight::viewMatrixOf(*pose, globe));
        camera.setProjectionMatrix(flight::projectionMatrixOf(*pose, globe, camera.getViewport()->aspectRatio()));
        drawUntilIdle();
    }

    void press(const std::string& key) {
        if (key.size() != 1) throw support::UsageError("--steps: press takes one key, not \"" + key + "\"");
        _viewer.getEventQueue()->keyPress(key[0]);
        _viewer.getEventQueue()->keyRelease(key[0]);
        drawUntilIdle();
    }

    void drawUntilIdle() {
        const osg::Timer_t begin = osg::Timer::instance()->tick();
        for (int idle = 0; idle < kIdleFrames;) {
            _viewer.frame();
            const osgDB::DatabasePager& pager = *_viewer.getDatabasePager();
            idle = pager.getRequestsInProgress() || pager.requiresUpdateSceneGraph() ? 0 : idle + 1;
            if (osg::Timer::instance()->delta_s(begin, osg::Timer::instance()->tick()) > kLongestWait)
                throw std::runtime_error("--steps: pages are still missing after two minutes; look for missing files");
        }
    }

    void drawFrames(int count) {
        for (int i = 0; i < count; ++i) _viewer.frame();
    }

    void takePicture(const std::string& fileName) {
        osg::Camera& camera = lastCamera(*_viewer.getCamera()->getGraphicsContext());
        const osg::ref_ptr<flight::FrameCapture> capture = new flight::FrameCapture;
        camera.addFinalDrawCallback(capture);
        capture->request(_viewer.getFrameStamp()->getFrameNumber() + 1);
        drawFrames(1);
        camera.removeFinalDrawCallback(capture);
        const osg::ref_ptr<osg::Image> picture = capture->take();
        if (!picture) throw std::runtime_error("--steps: a picture was never drawn");
        const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("JPEG_QUALITY 86");
        if (!osgDB::writeImageFile(*picture, fileName, options))
            throw std::runtime_error("--steps: " + fileName + " cannot be written");
    }

    osgViewer::Viewer& _viewer;
    const std::vector<flight::CameraPose> _poses;
};

}  // namespace

void runSteps(osgViewer::Viewer& viewer, const std::vector<flight::CameraPose>& poses, const std::string& text) {
    Steps(viewer, poses).run(text);
}

}  // namespace osgAnalyticBin::viewer

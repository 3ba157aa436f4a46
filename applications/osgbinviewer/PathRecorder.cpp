// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"
#include "Failure.h"
#include "Handlers.h"
#include "TextFile.h"

#include <osg/Notify>
#include <osgUtil/CullVisitor>
#include <osgUtil/SceneView>
#include <osgViewer/Renderer>

#include <cmath>

namespace osgAnalyticBin::viewer {

using flight::CameraPose;

namespace {

// Camera paths go no deeper: an eye near the earth's centre is none that somebody flies to.
constexpr double kLowestAltitude = -6.3e6;

// Clockwise about the line of sight, radians.
double rollOf(const osg::Vec3d& sight, const osg::Vec3d& up, const osg::Vec3d& upWithoutRoll) {
    const osg::Vec3d level = upWithoutRoll - sight * (sight * upWithoutRoll);
    return std::atan2((level ^ up) * sight, level * up);
}

// What OSG computed for the last frame. Returns: false when it computes none.
bool drawnPlanes(osg::Camera& camera, double& nearPlane, double& farPlane) {
    if (camera.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) return false;
    auto* renderer = dynamic_cast<osgViewer::Renderer*>(camera.getRenderer());
    const osgUtil::SceneView* sceneView = renderer ? renderer->getSceneView(0) : nullptr;
    if (!sceneView) return false;
    const double nearest = sceneView->getCullVisitor()->getCalculatedNearPlane();
    const double farthest = sceneView->getCullVisitor()->getCalculatedFarPlane();
    if (!(farthest > nearest) || farthest > 1e12) return false;
    // bounding boxes reach behind the eye
    nearPlane = std::max(nearest, farthest * camera.getNearFarRatio()) * 0.5;
    farPlane = farthest * 1.5;
    return true;
}

}  // namespace

std::optional<CameraPose> recordedPose(osg::Camera& camera, double time) {
    const auto globe = flight::findGlobe(camera);
    CameraPose pose;
    pose.time = time;
    double verticalFovDeg = 0.0;
    double aspect = 0.0;
    if (!globe || !camera.getProjectionMatrixAsPerspective(verticalFovDeg, aspect, pose.nearPlane, pose.farPlane))
        return std::nullopt;
    pose.verticalFov = osg::DegreesToRadians(verticalFovDeg);
    (void)drawnPlanes(camera, pose.nearPlane, pose.farPlane);
    osg::Vec3d eye;
    osg::Vec3d center;
    osg::Vec3d up;
    camera.getViewMatrixAsLookAt(eye, center, up);
    osg::Vec3d sight = center - eye;
    sight.normalize();
    const auto ground = globe->intersection(eye, sight);
    constexpr double kShortestSight = 100.0;
    pose.eye = globe->geodetic(eye);
    const double distance = std::max(kShortestSight, std::abs(pose.eye.altitude));
    pose.look = globe->geodetic(ground && (*ground - eye).length() > kShortestSight ? *ground : eye + sight * distance);
    if (pose.eye.altitude < kLowestAltitude || pose.look.altitude < kLowestAltitude) return std::nullopt;
    pose.roll = rollOf(sight, up, flight::upWithoutRoll(*globe, pose.eye, sight));
    return pose;
}

PathRecorder::PathRecorder(const std::string& fileName, double interval) : _fileName(fileName), _interval(interval) {
    addKey('R', "Start or stop recording the camera for osgbinbench.", [this](osgViewer::View&) {
        setRecording(!_isRecording);
        OSG_NOTICE << (_isRecording ? "recording the camera into " : "camera path written: ") << _fileName << std::endl;
    });
}

PathRecorder::~PathRecorder() {
    write();
}

void PathRecorder::setRecording(bool recording) {
    _isRecording = recording;
    if (!recording) write();
}

void PathRecorder::write() {
    if (_isWritten) return;
    _isWritten = true;
    try {
        support::writeFile(_fileName, textOf(_path));
    } catch (const support::Failure& failure) {
        OSG_WARN << "PathRecorder: " << failure.what() << std::endl;
    }
}

void PathRecorder::record(osg::Camera& camera, double time) {
    const bool isDue = _path.empty() || time >= _lastTime + _interval;
    if (!isDue || (!_path.empty() && camera.getViewMatrix() == _lastView)) return;
    const auto pose = recordedPose(camera, time);
    if (!pose) return;
    _path.push_back(*pose);
    _isWritten = false;
    _lastTime = time;
    constexpr double kSecondsUnwritten = 5.0;
    if (time >= _writtenAt + kSecondsUnwritten) {
        _writtenAt = time;
        write();
    }
    _lastView = camera.getViewMatrix();
}

void PathRecorder::draw(osgViewer::View& view, osg::Camera& camera) {
    // the frame before is the one that was drawn: in the first, number 1, the camera does not stand anywhere yet
    if (_isRecording && view.getFrameStamp()->getFrameNumber() > 1)
        record(camera, view.getFrameStamp()->getReferenceTime());
}

}  // namespace osgAnalyticBin::viewer

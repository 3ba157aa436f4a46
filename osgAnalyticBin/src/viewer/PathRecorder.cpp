// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <osgAnalyticBin/viewer/PathRecorder.h>

#include <osg/Notify>
#include <osgUtil/CullVisitor>
#include <osgUtil/SceneView>
#include <osgViewer/Renderer>
#include <osgViewer/View>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>

namespace osgAnalyticBin {

namespace {

const double kDegreesPerRadian = 180.0 / osg::PI;
// Camera paths go no deeper: an eye near the earth's centre is none that somebody flies to.
constexpr double kLowestAltitude = -6.3e6;
// Below this sine of the angle to the vertical a view has no "up" but north: as osgbinbench takes it.
constexpr double kStraight = 1e-4;

core::Geodetic toGeodetic(const SceneGlobe& globe, const osg::Vec3d& position) {
    const osg::Vec3d ecef = position * osg::Matrixd::inverse(globe.toWorld);
    core::Geodetic geodetic{};
    globe.ellipsoid->convertXYZToLatLongHeight(ecef.x(), ecef.y(), ecef.z(), geodetic.latitude, geodetic.longitude,
                                               geodetic.altitude);
    return geodetic;
}

osg::Vec3d upWithoutRoll(const SceneGlobe& globe, const core::Geodetic& eye, const osg::Vec3d& sight) {
    const double sinLatitude = std::sin(eye.latitude);
    const double cosLatitude = std::cos(eye.latitude);
    const osg::Vec3d outward(std::cos(eye.longitude), std::sin(eye.longitude), 0.0);
    const auto toWorld = [&](const osg::Vec3d& direction) {
        osg::Vec3d world = osg::Matrixd::transform3x3(direction, globe.toWorld);
        world.normalize();
        return world;
    };
    const osg::Vec3d vertical = toWorld(outward * cosLatitude + osg::Vec3d(0.0, 0.0, sinLatitude));
    if ((sight ^ vertical).length() >= kStraight) return vertical;
    return toWorld(outward * -sinLatitude + osg::Vec3d(0.0, 0.0, cosLatitude));
}

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

std::optional<RecordedPose> recordedPose(osg::Camera& camera, double time) {
    const auto globe = globeOf(camera);
    RecordedPose pose;
    pose.time = time;
    double verticalFovDeg = 0.0;
    double aspect = 0.0;
    if (!globe || !camera.getProjectionMatrixAsPerspective(verticalFovDeg, aspect, pose.nearPlane, pose.farPlane)) {
        return std::nullopt;
    }
    pose.verticalFov = verticalFovDeg / kDegreesPerRadian;
    (void)drawnPlanes(camera, pose.nearPlane, pose.farPlane);
    osg::Vec3d eye;
    osg::Vec3d center;
    osg::Vec3d up;
    camera.getViewMatrixAsLookAt(eye, center, up);
    osg::Vec3d sight = center - eye;
    sight.normalize();
    const auto ground = globe->intersection(eye, sight);
    constexpr double kShortestSight = 100.0;
    const double distance = std::max(kShortestSight, std::abs(globe->altitude(eye)));
    pose.eye = toGeodetic(*globe, eye);
    pose.look =
        toGeodetic(*globe, ground && (*ground - eye).length() > kShortestSight ? *ground : eye + sight * distance);
    if (pose.eye.altitude < kLowestAltitude || pose.look.altitude < kLowestAltitude) return std::nullopt;
    pose.roll = rollOf(sight, up, upWithoutRoll(*globe, pose.eye, sight));
    return pose;
}

void writeCameraPath(std::ostream& out, const std::vector<RecordedPose>& path, PathColumns columns) {
    const bool isInTime = columns == PathColumns::PosesInTime;
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far"
        << (isInTime ? ",time,rollDeg" : "") << '\n';
    std::size_t number = 0;
    for (const RecordedPose& pose : path) {
        out << 'p' << ++number;
        for (const core::Geodetic& point : {pose.eye, pose.look}) {
            out << ',' << point.latitude * kDegreesPerRadian << ',' << point.longitude * kDegreesPerRadian << ','
                << point.altitude;
        }
        out << ',' << pose.verticalFov * kDegreesPerRadian << ',' << pose.nearPlane << ',' << pose.farPlane;
        if (isInTime) out << ',' << pose.time << ',' << pose.roll * kDegreesPerRadian;
        out << '\n';
    }
}

bool writeCameraPathFile(const std::string& fileName, const std::vector<RecordedPose>& path, PathColumns columns,
                         std::string& error) {
    const std::string temporary = fileName + ".part";
    {
        std::ofstream out(temporary);
        if (out) writeCameraPath(out, path, columns);
        out.close();
        std::error_code problem;
        if (out) std::filesystem::rename(temporary, fileName, problem);  // replaces a file, also on Windows
        if (out && !problem) return true;
    }
    std::remove(temporary.c_str());
    error = fileName + ": cannot be written";
    return false;
}

PathRecorder::PathRecorder(const std::string& fileName, double interval, PathColumns columns)
    : _fileName(fileName), _interval(interval), _columns(columns) {}

PathRecorder::~PathRecorder() {
    write();
}

void PathRecorder::setRecording(bool recording) {
    _isRecording = recording;
    if (!recording) write();
}

void PathRecorder::write() {
    if (_isWritten) return;
    std::string error;
    const bool isGood = writeCameraPathFile(_fileName, _path, _columns, error);
    _isWritten = true;
    if (!isGood) OSG_WARN << "PathRecorder: " << error << "; choose another file." << std::endl;
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

bool PathRecorder::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    osgViewer::View* view = viewOf(action);
    if (!view || isTaken(event)) return false;
    if (event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN && event.getKey() == _key) {
        setRecording(!_isRecording);
        OSG_NOTICE << (_isRecording ? "recording the camera into " : "camera path written: ") << _fileName << std::endl;
        return true;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME || !_isRecording) return false;
    const std::vector<osg::Camera*> cameras = drawingCameras(*view);
    // the frame before is the one that was drawn: in the first, number 1, the camera does not stand anywhere yet
    if (!cameras.empty() && view->getFrameStamp()->getFrameNumber() > 1) {
        record(*cameras.front(), view->getFrameStamp()->getReferenceTime());
    }
    return false;
}

void PathRecorder::getUsage(osg::ApplicationUsage& usage) const {
    usage.addKeyboardMouseBinding(_key, "Start or stop recording the camera for osgbinbench.");
}

}  // namespace osgAnalyticBin

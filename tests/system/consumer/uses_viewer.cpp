// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinDisplayHandler.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/CameraPath.h>
#include <osgAnalyticBin/viewer/FreezeCullHandler.h>
#include <osgAnalyticBin/viewer/MethodSwitchHandler.h>
#include <osgAnalyticBin/viewer/PathRecorder.h>
#include <osgAnalyticBin/viewer/SpyViewHandler.h>

#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <sstream>
#include <string>

int main() {
    osgViewer::Viewer viewer;
    const osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    viewer.addEventHandler(new osgAnalyticBin::FreezeCullHandler);
    viewer.addEventHandler(new osgAnalyticBin::SpyViewHandler);
    viewer.addEventHandler(new osgAnalyticBin::BinDisplayHandler);
    viewer.addEventHandler(new osgAnalyticBin::MethodSwitchHandler);
    viewer.addEventHandler(new osgAnalyticBin::BinStatsHandler(*stats));
    viewer.addEventHandler(stats);
    std::stringstream path;
    osgAnalyticBin::flight::CameraPose pose;
    pose.eye.altitude = 1000.0;
    pose.verticalFov = 1.0;
    pose.nearPlane = 1.0;
    pose.farPlane = 1e6;
    osgAnalyticBin::flight::writeCameraPath(path, {pose}, osgAnalyticBin::flight::PathColumns::Poses);
    std::string error;
    const auto read = osgAnalyticBin::flight::readCameraPath(path, "path", error);
    return viewer.getEventHandlers().size() == 6 && read && read->front().name == "p1" ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/CameraPath.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <sstream>
#include <string>

int main() {
    osgViewer::Viewer viewer;
    const osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    viewer.addEventHandler(new osgAnalyticBin::BinStatsHandler(*stats));
    viewer.addEventHandler(stats);
    osgAnalyticBin::CameraCulling& culling = osgAnalyticBin::CameraCulling::of(*viewer.getCamera());
    culling.freeze(osgAnalyticBin::CameraCulling::cullingView(*viewer.getCamera()));
    std::stringstream path;
    osgAnalyticBin::flight::CameraPose pose;
    pose.eye.altitude = 1000.0;
    pose.verticalFov = 1.0;
    pose.nearPlane = 1.0;
    pose.farPlane = 1e6;
    osgAnalyticBin::flight::writeCameraPath(path, {pose}, osgAnalyticBin::flight::PathColumns::Poses);
    std::string error;
    const auto read = osgAnalyticBin::flight::readCameraPath(path, "path", error);
    const bool isCounted = viewer.getEventHandlers().size() == 2 && osgAnalyticBin::binCounts(viewer).tested == 0;
    return isCounted && culling.isFrozen() && read && read->front().name == "p1" ? 0 : 1;
}

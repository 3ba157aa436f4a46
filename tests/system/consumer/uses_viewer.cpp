// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinDisplayHandler.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/FreezeCullHandler.h>
#include <osgAnalyticBin/viewer/MethodSwitchHandler.h>
#include <osgAnalyticBin/viewer/PathRecorder.h>
#include <osgAnalyticBin/viewer/SpyViewHandler.h>

#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

int main() {
    osgViewer::Viewer viewer;
    const osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    viewer.addEventHandler(new osgAnalyticBin::FreezeCullHandler);
    viewer.addEventHandler(new osgAnalyticBin::SpyViewHandler);
    viewer.addEventHandler(new osgAnalyticBin::BinDisplayHandler);
    viewer.addEventHandler(new osgAnalyticBin::MethodSwitchHandler);
    viewer.addEventHandler(new osgAnalyticBin::BinStatsHandler(*stats));
    viewer.addEventHandler(stats);
    return viewer.getEventHandlers().size() == 6 ? 0 : 1;
}

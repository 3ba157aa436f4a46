// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

int main() {
    osgViewer::Viewer viewer;
    const osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    viewer.addEventHandler(new osgAnalyticBin::BinStatsHandler(*stats));
    viewer.addEventHandler(stats);
    osgAnalyticBin::CameraCulling& culling = osgAnalyticBin::CameraCulling::of(*viewer.getCamera());
    culling.freeze(osgAnalyticBin::CameraCulling::cullingView(*viewer.getCamera()));
    const bool isCounted = viewer.getEventHandlers().size() == 2 && osgAnalyticBin::binCounts(viewer).tested == 0;
    return isCounted && culling.isFrozen() ? 0 : 1;
}

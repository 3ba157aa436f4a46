// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/Stats>
#include <osgUtil/CullVisitor>
#include <osgUtil/SceneView>
#include <osgViewer/Renderer>
#include <osgViewer/ViewerBase>
#include <osgViewer/ViewerEventHandlers>

#include <array>
#include <initializer_list>
#include <string>

namespace osgAnalyticBin {

namespace {

struct Line {
    const char* name;
    osg::Vec4 colour;
    std::size_t TileCounts::*count;
};

const std::array<Line, 5> kLines{{{"tested", {0.8F, 0.8F, 0.8F, 1.0F}, &TileCounts::tested},
                                  {"kept", {1.0F, 0.85F, 0.15F, 1.0F}, &TileCounts::kept},
                                  {"drawn", {0.3F, 1.0F, 0.35F, 1.0F}, &TileCounts::drawn},
                                  {"hidden", {0.35F, 0.6F, 1.0F, 1.0F}, &TileCounts::hidden},
                                  {"beyond an edge", {1.0F, 0.35F, 1.0F, 1.0F}, &TileCounts::reverseCulled}}};

std::string attributeName(unsigned int camera, const Line& line) {
    const std::string whose = camera == 0 ? "Tiles " : "Camera " + std::to_string(camera + 1) + " tiles ";
    return whose + line.name;
}

// What the bins themselves counted in a frame. Returns: false when none did.
bool addCounts(osg::Camera& camera, unsigned int frame, TileCounts& counts) {
    auto* renderer = dynamic_cast<osgViewer::Renderer*>(camera.getRenderer());
    bool found = false;
    for (unsigned int i = 0; renderer && i < 2; ++i) {
        osgUtil::SceneView* sceneView = renderer->getSceneView(i);
        if (!sceneView) continue;
        for (osgUtil::CullVisitor* visitor :
             {sceneView->getCullVisitor(), sceneView->getCullVisitorLeft(), sceneView->getCullVisitorRight()}) {
            const BinStatistics* statistics = visitor ? BinStatistics::find(*visitor) : nullptr;
            if (!statistics) continue;
            const BinCounts bins = statistics->counts();
            if (bins.frame != frame || bins.tested == 0) continue;
            counts.tested += bins.tested;
            counts.kept += bins.tested - bins.outside;
            counts.hidden += bins.hidden;
            counts.reverseCulled += bins.separated;
            found = true;
        }
    }
    return found;
}

// Those of the last frame.
TileCounts countsOf(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const TileCounts surveyed = TileSurvey(camera, frameStamp).counts();
    TileCounts counts;
    if (!addCounts(camera, frameStamp.getFrameNumber() - 1, counts)) return surveyed;
    counts.drawn = surveyed.drawn;
    return counts;
}

}  // namespace

BinStatsHandler::BinStatsHandler(osgViewer::StatsHandler& stats, unsigned int cameras, float mostTiles)
    : _cameras(cameras) {
    for (unsigned int camera = 0; camera < cameras; ++camera) {
        for (const Line& line : kLines) {
            const std::string name = attributeName(camera, line);
            stats.addUserStatsLine(name, line.colour, line.colour, name, 1.0F, true, false, "", "", mostTiles);
        }
    }
}

BinStatsHandler::~BinStatsHandler() = default;

bool BinStatsHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    osgViewer::View* view = viewOf(action);
    if (!view || event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
    osg::Stats* stats = view->getViewerBase()->getViewerStats();
    osg::FrameStamp& frameStamp = *view->getFrameStamp();
    // what the StatsHandler asks for as long as it shows anything
    if (!stats || !stats->collectStats("frame_rate") || frameStamp.getFrameNumber() == 0) return false;
    const std::vector<osg::Camera*> cameras = drawingCameras(*view);
    for (unsigned int i = 0; i < _cameras && i < cameras.size(); ++i) {
        const TileCounts counts = countsOf(*cameras[i], frameStamp);
        for (const Line& line : kLines) {
            stats->setAttribute(frameStamp.getFrameNumber() - 1, attributeName(i, line),
                                static_cast<double>(counts.*line.count));
        }
    }
    return false;
}

}  // namespace osgAnalyticBin

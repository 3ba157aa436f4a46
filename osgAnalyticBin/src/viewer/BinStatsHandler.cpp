// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osg/Stats>
#include <osgViewer/View>
#include <osgViewer/ViewerBase>
#include <osgViewer/ViewerEventHandlers>

#include <array>
#include <string>

namespace osgAnalyticBin {

namespace {

struct Line {
    const char* name;
    osg::Vec4 colour;
    std::size_t TileCounts::*count;
};

const std::array<Line, 6> kLines{{{"tested", {0.8F, 0.8F, 0.8F, 1.0F}, &TileCounts::tested},
                                  {"kept", {1.0F, 0.85F, 0.15F, 1.0F}, &TileCounts::kept},
                                  {"drawn", {0.3F, 1.0F, 0.35F, 1.0F}, &TileCounts::drawn},
                                  {"hidden", {0.35F, 0.6F, 1.0F, 1.0F}, &TileCounts::hidden},
                                  {"beyond an edge", {1.0F, 0.35F, 1.0F, 1.0F}, &TileCounts::beyondEdge},
                                  {"behind terrain", {0.75F, 0.55F, 0.35F, 1.0F}, &TileCounts::occluded}}};

std::string attributeName(unsigned int camera, const Line& line) {
    const std::string whose = camera == 0 ? "Tiles " : "Camera " + std::to_string(camera + 1) + " tiles ";
    return whose + line.name;
}

// Those of the last frame; without bins, those of a survey.
TileCounts countsOf(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    TileCounts counts = TileSurvey(camera, frameStamp).counts();
    const BinCounts bins = binCounts(camera, frameStamp.getFrameNumber() - 1);
    if (bins.tested == 0) return counts;
    counts.tested = bins.tested;
    counts.kept = bins.tested - bins.outside;
    counts.hidden = bins.hidden;
    counts.beyondEdge = bins.beyondEdge;
    counts.occluded = bins.occluded;
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
    auto* view = dynamic_cast<osgViewer::View*>(action.asView());
    if (!view || event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
    osg::Stats* stats = view->getViewerBase()->getViewerStats();
    osg::FrameStamp& frameStamp = *view->getFrameStamp();
    // what the StatsHandler asks for as long as it shows anything
    if (!stats || !stats->collectStats("frame_rate") || frameStamp.getFrameNumber() == 0) return false;
    const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(*view);
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

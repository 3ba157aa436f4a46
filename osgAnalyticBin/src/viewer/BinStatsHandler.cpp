// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osg/NodeVisitor>
#include <osg/Stats>
#include <osgText/Text>
#include <osgViewer/View>
#include <osgViewer/ViewerBase>
#include <osgViewer/ViewerEventHandlers>

#include <algorithm>
#include <array>

namespace osgAnalyticBin {

namespace {

struct Line {
    const char* name;
    osg::Vec4 colour;
    std::size_t TileCounts::*count;
};

Line lineOf(TileVerdict verdict, std::size_t TileCounts::*count) {
    return {verdictName(verdict), verdictColour(verdict), count};
}

const std::array<Line, 6> kLines{{{"tested", {0.55F, 0.55F, 0.55F, 1.0F}, &TileCounts::tested},
                                  {"kept", {0.75F, 0.75F, 0.75F, 1.0F}, &TileCounts::kept},
                                  {"drawn", {1.0F, 1.0F, 1.0F, 1.0F}, &TileCounts::drawn},
                                  lineOf(TileVerdict::Hidden, &TileCounts::hidden),
                                  lineOf(TileVerdict::BeyondEdge, &TileCounts::beyondEdge),
                                  lineOf(TileVerdict::Occluded, &TileCounts::occluded)}};

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

// The texts of values in what a StatsHandler shows: each comes behind the text that names it.
class ValueFinder : public osg::NodeVisitor {
public:
    explicit ValueFinder(std::map<std::string, osg::ref_ptr<osgText::Text>>& values)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _values(values) {
        setNodeMaskOverride(~0U);
    }

    void apply(osg::Drawable& drawable) override {
        auto* const text = dynamic_cast<osgText::Text*>(&drawable);
        if (!text) return;
        const auto known = _values.find(_last);
        if (known != _values.end()) known->second = text;
        _last = text->getText().createUTF8EncodedString();
        _last.erase(std::min(_last.size(), _last.find(':')));
    }

private:
    std::map<std::string, osg::ref_ptr<osgText::Text>>& _values;
    std::string _last;
};

}  // namespace

BinStatsHandler::BinStatsHandler(osgViewer::StatsHandler& stats, unsigned int cameras, float mostTiles)
    : _stats(&stats), _cameras(cameras) {
    for (unsigned int camera = 0; camera < cameras; ++camera) {
        for (const Line& line : kLines) {
            const std::string name = attributeName(camera, line);
            stats.addUserStatsLine(name, line.colour, line.colour, name, 1.0F, true, false, "", "", mostTiles);
            _values[name];
        }
    }
}

BinStatsHandler::~BinStatsHandler() = default;

// OSG's own would have decimals, and be means over some frames.
void BinStatsHandler::showCount(const std::string& name, std::size_t count) {
    osg::ref_ptr<osgText::Text>& value = _values[name];
    osg::ref_ptr<osgViewer::StatsHandler> stats;
    const bool isKnown = value && value->getNumParents() > 0;
    if (!isKnown && _stats.lock(stats)) {
        ValueFinder finder(_values);
        stats->getCamera()->accept(finder);
    }
    if (!value) return;
    value->setDataVariance(osg::Object::DYNAMIC);
    value->setDrawCallback(nullptr);
    value->setText(std::to_string(count));
}

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
            const std::string name = attributeName(i, line);
            stats->setAttribute(frameStamp.getFrameNumber() - 1, name, static_cast<double>(counts.*line.count));
            showCount(name, counts.*line.count);
        }
    }
    return false;
}

}  // namespace osgAnalyticBin

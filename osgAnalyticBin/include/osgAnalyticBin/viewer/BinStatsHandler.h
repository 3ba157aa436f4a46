// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/Export.h>

#include <osg/observer_ptr>
#include <osg/ref_ptr>
#include <osgGA/GUIEventHandler>

#include <cstddef>
#include <map>
#include <string>

namespace osgText {
class Text;
}
namespace osgViewer {
class StatsHandler;
}

namespace osgAnalyticBin {

/// Adds lines and graphs to OSG's own StatsHandler: tiles tested, kept and drawn, and those behind the horizon, beyond
/// an edge and behind terrain, for each camera of the view, frame by frame. The counts are attributes of the viewer's
/// osg::Stats, named "Tiles tested", "Tiles kept", "Tiles drawn", "Tiles behind the horizon" and so on (verdictName());
/// for a second camera of the view "Camera 2 tiles tested" and so on. Counts of bins are the culling's own counters
/// (BinStatistics). Drawn tiles, and all counts where no bin decides, come from a TileSurvey.
/// Cost: nothing while statistics are not shown; else a TileSurvey for each camera and frame.
class OSGANALYTICBINVIEWER_EXPORT BinStatsHandler : public osgGA::GUIEventHandler {
public:
    /// Adds the lines to a StatsHandler that has not been shown yet. `mostTiles`: the graphs' top.
    explicit BinStatsHandler(osgViewer::StatsHandler& stats, unsigned int cameras = 1, float mostTiles = 200.0F);

    /// Counts at every frame. Returns: false, because the handler has no keys.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

protected:
    ~BinStatsHandler() override;

private:
    void showCount(const std::string& name, std::size_t count);

    const osg::observer_ptr<osgViewer::StatsHandler> _stats;
    const unsigned int _cameras;
    std::map<std::string, osg::ref_ptr<osgText::Text>> _values;  // that are shown, by name
};

}  // namespace osgAnalyticBin

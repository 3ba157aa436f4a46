// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/Export.h>

#include <osgGA/GUIEventHandler>

namespace osgViewer {
class StatsHandler;
}

namespace osgAnalyticBin {

/// Lines and graphs in OSG's own StatsHandler: tiles tested, kept, drawn, hidden by the horizon and culled in reverse,
/// for each camera of the view, frame by frame. The counts are attributes of the viewer's osg::Stats, named
/// "Tiles tested", "Tiles kept", "Tiles drawn", "Tiles hidden" and "Tiles beyond an edge"; for a second camera of the
/// view "Camera 2 tiles tested" and so on. Those of bins are the culling's own counters (BinStatistics); tiles drawn,
/// and all of them where no bin decides, are counted by a TileSurvey.
/// Cost: nothing while statistics are not shown; else a TileSurvey for each camera and frame.
class OSGANALYTICBINVIEWER_EXPORT BinStatsHandler : public osgGA::GUIEventHandler {
public:
    /// Adds the lines to a StatsHandler that has not been shown yet. `mostTiles`: the graphs' top.
    explicit BinStatsHandler(osgViewer::StatsHandler& stats, unsigned int cameras = 1, float mostTiles = 200.0F);

    /// Counts at every frame. Returns: false, for it has no keys.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

protected:
    ~BinStatsHandler() override;

private:
    const unsigned int _cameras;
};

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/Export.h>

#include <osgGA/GUIEventHandler>

namespace osgViewer {
class StatsHandler;
}

namespace osgAnalyticBin {

/// Adds lines and graphs to OSG's own StatsHandler: tiles tested, kept, drawn, hidden by the horizon, beyond an edge
/// and behind terrain, for each camera of the view, frame by frame. The counts are attributes of the viewer's
/// osg::Stats, named "Tiles tested", "Tiles kept", "Tiles drawn", "Tiles hidden", "Tiles beyond an edge" and "Tiles
/// behind terrain"; for a second camera of the view "Camera 2 tiles tested" and so on. Counts of bins are the culling's
/// own counters (BinStatistics). Drawn tiles, and all counts where no bin decides, come from a TileSurvey.
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
    const unsigned int _cameras;
};

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "WorkPlan.h"

#include "Failure.h"

#include <algorithm>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

// A whole globe without insets is just below: 128 tasks, one for each start tile.
constexpr double kFewestTasks = 100.0;
// Half a minute's work: as much is lost in each thread when a run is ended, and waited for at its end.
constexpr double kMostWeight = 4096.0;

Task taskFor(const TileId& tile, DemMosaic& mosaic, const TileLayout& layout) {
    return {tile, 1.0 + mosaic.posts(tile.rect()) / (static_cast<double>(layout.cells()) * layout.cells())};
}

void split(const Task& task, double most, DemMosaic& mosaic, EdgeDepths& depths, const TileLayout& layout,
           std::vector<Task>& tasks) {
    if (task.weight <= most || !depths.hasChildren(task.tile)) {
        tasks.push_back(task);
        return;
    }
    for (const TileId& child : task.tile.children()) {
        split(taskFor(child, mosaic, layout), most, mosaic, depths, layout, tasks);
    }
}

}  // namespace

TileLayout layoutFor(const Settings& settings, const DemMosaic& mosaic) {
    const int cells = settings.cells.value_or(TileLayout::cellsFor(mosaic.finestGlobalDeg()));
    const int levels = settings.levels.value_or(TileLayout::levelFor(mosaic.finestDeg(), cells));
    return TileLayout(cells, levels, settings.ellipsoid, settings.region);
}

TileLayout checkedLayoutFor(const Settings& settings) {
    DemMosaic mosaic(settings);
    mosaic.requireData();
    if (settings.region && !(mosaic.posts(*settings.region) > 0.0)) {
        throw Failure("no raster has a part within -te; give degrees as WEST SOUTH EAST NORTH");
    }
    return layoutFor(settings, mosaic);
}

double weightOf(const std::vector<Task>& tasks) {
    double sum = 0.0;
    for (const Task& task : tasks) sum += task.weight;
    return sum;
}

std::vector<Task> planTasks(DemMosaic& mosaic, EdgeDepths& depths, const TileLayout& layout) {
    std::vector<Task> starts;
    double sum = 0.0;
    for (const TileId& tile : layout.startTiles()) {
        starts.push_back(taskFor(tile, mosaic, layout));
        sum += starts.back().weight;
    }
    std::vector<Task> tasks;
    const double most = std::min(sum / kFewestTasks, kMostWeight);
    for (const Task& start : starts) split(start, most, mosaic, depths, layout, tasks);
    return tasks;
}

std::vector<Task> planTasks(const Settings& settings, const TileLayout& layout) {
    DemMosaic mosaic(settings, layout.spacingDeg(layout.deepestLevel()));
    EdgeDepths depths(mosaic, layout);
    return planTasks(mosaic, depths, layout);
}

}  // namespace osgbindem

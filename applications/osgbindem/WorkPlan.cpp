// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "WorkPlan.h"

namespace osgbindem {

namespace {

// A finished task waits in memory with one tile; this bounds how many there can be.
constexpr std::size_t kMostTasks = 1000;
constexpr double kTasksPerThread = 16.0;

Task taskFor(const TileId& tile, DemMosaic& mosaic, const TileLayout& layout) {
    return {tile, 1.0 + mosaic.posts(tile.rect()) / (static_cast<double>(layout.cells()) * layout.cells())};
}

void split(const Task& task, double most, DemMosaic& mosaic, EdgeDepths& depths, const TileLayout& layout,
           std::vector<Task>& tasks) {
    if (task.weight <= most || tasks.size() >= kMostTasks || !depths.hasChildren(task.tile)) {
        tasks.push_back(task);
        return;
    }
    for (const TileId& child : task.tile.children()) {
        split(taskFor(child, mosaic, layout), most, mosaic, depths, layout, tasks);
    }
}

}  // namespace

std::vector<Task> planTasks(DemMosaic& mosaic, EdgeDepths& depths, const TileLayout& layout, int threads) {
    std::vector<Task> starts;
    double sum = 0.0;
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            starts.push_back(taskFor({0, x, y}, mosaic, layout));
            sum += starts.back().weight;
        }
    }
    std::vector<Task> tasks;
    for (const Task& start : starts) split(start, sum / (kTasksPerThread * threads), mosaic, depths, layout, tasks);
    return tasks;
}

}  // namespace osgbindem

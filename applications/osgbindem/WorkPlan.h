// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "EdgeDepths.h"

#include <vector>

namespace osgbindem {

/// The layout that the settings ask for, or else the rasters.
[[nodiscard]] TileLayout layoutFor(const Settings& settings, const DemMosaic& mosaic);

/// The same once every raster is known to have heights; the rasters are closed again. Throws Failure.
[[nodiscard]] TileLayout checkedLayoutFor(const Settings& settings);

/// A subtree that one thread builds by itself.
struct Task {
    TileId tile;
    /// About the number of tiles without children in it.
    double weight = 0.0;
};

/// Divides the tree into subtrees of similar weight; neighbours follow each other. What lies above the subtrees is left
/// for afterwards. The plan is the same however many threads and programs share the work, so that others can go on.
[[nodiscard]] std::vector<Task> planTasks(DemMosaic& mosaic, EdgeDepths& depths, const TileLayout& layout);
[[nodiscard]] std::vector<Task> planTasks(const Settings& settings, const TileLayout& layout);

[[nodiscard]] double weightOf(const std::vector<Task>& tasks);

}  // namespace osgbindem

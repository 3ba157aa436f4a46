// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ScaleScene.h"
#include "Settings.h"

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::scale {

/// One method over the flight down a globe of some depth; sums over the poses.
struct DepthRow {
    int levels = 0;
    std::string method;
    TileTally tiles;
    double cullMs = 0.0;
    double cullSpreadMs = 0.0;  ///< from the first quartile to the third

    [[nodiscard]] double usPerDrawnTile() const {
        return tiles.drawn ? 1000.0 * cullMs / static_cast<double>(tiles.drawn) : 0.0;
    }
};

/// One method with some number of PagedLODs in memory; milliseconds.
struct ResidentRow {
    std::size_t pagedLods = 0;
    std::string method;
    TileTally tiles;
    double cullMs = 0.0;
    double cullSpreadMs = 0.0;
    double updateMs = 0.0;
    double pagerIdleMs = 0.0;  ///< the DatabasePager's update, with fewer PagedLODs than its target
    double pagerFullMs = 0.0;  ///< with more, none of which may go yet
};

/// What tiles in memory take, by what is installed on them.
struct MemoryRow {
    std::string method;  ///< "no bins", "stored bins", or a method
    std::size_t tiles = 0;
    double bytesPerTile = 0.0;   ///< 0 where malloc does not count
    double loadUsPerTile = 0.0;  ///< making the tile and installing its bin, in the pager's thread as a rule
};

/// Throws: Failure.
[[nodiscard]] std::vector<DepthRow> measureDepth(const Settings& settings);
[[nodiscard]] std::vector<ResidentRow> measureResidents(const Settings& settings);
[[nodiscard]] std::vector<MemoryRow> measureMemory(const Settings& settings);

/// The flight's stops, from 10 000 km above the terrain down to where tiles of the deepest level are near enough.
[[nodiscard]] std::vector<flight::CameraPose> descent(const globe::GlobeOptions& options, int poses);

}  // namespace osgAnalyticBin::scale

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace osgbinconv {

/// The latitudes and longitudes of a tile's own surface, in radians, and by how much they may be wrong.
struct TileRect {
    osgAnalyticBin::core::Interval latitude;
    osgAnalyticBin::core::Interval longitude;
    double latitudeTolerance = 0.0;
    double longitudeTolerance = 0.0;

    [[nodiscard]] TileRect turned(double turn) const;
};

/// Requires: the surface is valid.
[[nodiscard]] TileRect rectOf(const osgAnalyticBin::TileSurface& surface);

/// Radians by which two intervals overlap; negative: they are apart.
[[nodiscard]] double overlap(const osgAnalyticBin::core::Interval& a, const osgAnalyticBin::core::Interval& b);

/// Whether two rectangles have a point in common, tolerances included.
[[nodiscard]] bool touch(const TileRect& a, const TileRect& b);

/// A tile beside another one. A tile round the whole globe is its own neighbour.
struct Neighbour {
    std::uint32_t tile = 0;
    /// To be added to its longitudes, so that they lie beside the other's: a multiple of 2 pi.
    double turn = 0.0;
};

/// For each tile those of the same depth that touch it along more than a corner. Tiles without known surface have none
/// and are none.
[[nodiscard]] std::vector<std::vector<Neighbour>> findNeighbours(const std::vector<TreeTile>& tiles);

}  // namespace osgbinconv

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::indexing {

/// The latitudes and longitudes of a tile's own surface, in radians, and their error bounds.
struct TileRect {
    osgAnalyticBin::core::Interval latitude;
    osgAnalyticBin::core::Interval longitude;
    double latitudeTolerance = 0.0;
    double longitudeTolerance = 0.0;

    [[nodiscard]] TileRect turned(double turn) const;
};

/// Requires: the surface is valid.
[[nodiscard]] TileRect rectOf(const osgAnalyticBin::TileSurface& surface);

/// Whether two rectangles have a point in common, tolerances included.
[[nodiscard]] bool touch(const TileRect& a, const TileRect& b);

/// A tile beside another one. A tile round the whole globe is its own neighbour.
struct Neighbour {
    std::uint32_t tile = 0;
    /// To be added to its longitudes, so that they lie beside the other's: a multiple of 2 pi.
    double turn = 0.0;
};

/// What stands beside the tiles, by their indices.
struct Neighbourhood {
    /// The tiles of the same depth that touch each along more than a corner.
    std::vector<std::vector<Neighbour>> neighbours;
    /// Whether more tiles lie there than are looked at: then none is listed.
    std::vector<bool> isCrowded;
    /// Pairs of tiles that were compared.
    std::size_t comparisons = 0;
};

/// The most tiles that are looked at for one. Grids have 8, insets of finer tiles some dozens; without a bound, tiles
/// that are stacked in one place would take the square of their number.
inline constexpr std::size_t kMostBeside = 256;

/// Tiles without known surface have no neighbours and are none.
[[nodiscard]] Neighbourhood findNeighbours(const std::vector<TreeTile>& tiles);

}  // namespace osgAnalyticBin::indexing

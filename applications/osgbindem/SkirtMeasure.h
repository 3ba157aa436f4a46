// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "TerrainGrid.h"
#include "TileLayout.h"

#include <map>

namespace osgbindem {

/// Knows which tiles have children, and measures how deep a tile's skirt has to be.
/// A tile has children when a raster finer than its posts has data in it, and the tile is part of the region.
///
/// Where tiles of two levels meet, their edges are two polylines through the same terrain, and the crack between them
/// is filled by the skirt of the one that is higher. Tiles of one level share their edge posts and need no skirt.
/// Next to a tile there can stand, across its edge, (1) a tile of the parent's level: levels of tiles in view differ by
/// one when the switching distance is at least three half diagonals, because then the ring of one level is wider than
/// two tiles; (2) a coarser tile that has no children, whatever the difference; (3) tiles below the neighbour, down to
/// the deepest. So the skirt covers what the own polyline is above that of every such level, measured between points
/// in space, which has the sag of the chords in it. At a post, the skirt is as deep as the deepest crack on either side
/// of it, or reaches down to the lowest point there, and a small safety beyond: relief and sag along the edge bound it.
///
/// A chord between posts of one parallel also runs poleward of it. Seen from above that opens a narrow strip, which no
/// vertical wall closes; the skirt leans outward by as much.
class SkirtMeasure final {
public:
    SkirtMeasure(DemMosaic& mosaic, const TileLayout& layout) : _mosaic(mosaic), _layout(layout) {}

    [[nodiscard]] bool hasChildren(const TileId& tile);

    /// The level of the tile without children that lies across the edge, or the given tile's level if that is less.
    [[nodiscard]] int coarsestAcross(const TileId& tile, Edge edge);

    /// Gives the tile its skirts, rounded up to whole steps. Requires: `grid` has its heights.
    void measure(const TileId& tile, osgAnalyticBin::TerrainGrid& grid);

private:
    DemMosaic& _mosaic;
    const TileLayout& _layout;
    std::map<TileId, bool> _known;
};

}  // namespace osgbindem

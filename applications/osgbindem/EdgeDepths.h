// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "TileLayout.h"

#include <array>
#include <map>

namespace osgbindem {

/// The edge across from an edge of the same tile.
[[nodiscard]] Edge oppositeOf(Edge edge);

/// The children of a tile that stand along one of its edges.
[[nodiscard]] std::array<TileId, 2> childrenAlong(const TileId& tile, Edge edge);

/// Knows which tiles have children, and so how deep the tree is on either side of an edge.
/// A tile has children when a raster finer than its posts has data in it, and the tile is part of the region.
class EdgeDepths final {
public:
    EdgeDepths(DemMosaic& mosaic, const TileLayout& layout) : _mosaic(mosaic), _layout(layout) {}

    [[nodiscard]] bool hasChildren(const TileId& tile);

    /// The level of the tile without children that lies across the edge, or the given tile's level if that is less.
    [[nodiscard]] int coarsestAcross(const TileId& tile, Edge edge);

private:
    DemMosaic& _mosaic;
    const TileLayout& _layout;
    std::map<TileId, bool> _known;
};

}  // namespace osgbindem

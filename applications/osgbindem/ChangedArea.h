// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "EdgeDepths.h"
#include "RasterGrid.h"
#include "TileLayout.h"

#include <functional>
#include <utility>
#include <vector>

namespace osgbindem {

/// Where heights, how fine they are, or colours may have changed since a database was built.
class ChangedArea final {
public:
    /// A rectangle of which posts may have changed, with the cells between them and their neighbours.
    void add(const RectDeg& rect) { _rects.push_back(rect); }

    [[nodiscard]] bool empty() const noexcept { return _rects.empty(); }

    /// Whether the rectangles have a point in common; longitudes count modulo 360, a pole is one point.
    [[nodiscard]] bool touches(const RectDeg& rect) const noexcept;

private:
    std::vector<RectDeg> _rects;
};

/// Tells which tiles of a database come out as they are when it is built again.
///
/// A tile's mesh depends on heights within one spacing of posts around it, or on those between the posts of a coarser
/// neighbour along the edge; its skirts depend besides on which of its neighbours, of those above them, and of those
/// below them along the edge have children. Its bin depends on the tiles below. What changes for a tile changes for all
/// above it, so a tile that stays has no changes below.
class ChangedTiles final {
public:
    using HadChildren = std::function<bool(const TileId&)>;

    /// `depths` of the rasters as they are now; `hadChildren` of the database as it is.
    ChangedTiles(const ChangedArea& area, EdgeDepths& depths, const TileLayout& layout, HadChildren hadChildren)
        : _area(area), _depths(depths), _layout(layout), _hadChildren(std::move(hadChildren)) {}

    /// Whether the tile, or one below it, may come out otherwise.
    [[nodiscard]] bool has(const TileId& tile) const;

private:
    [[nodiscard]] bool hasChangedHeights(const TileId& tile) const;
    [[nodiscard]] bool isRefinedOtherwise(const TileId& tile) const;
    [[nodiscard]] bool isRefinedOtherwiseAbove(const TileId& neighbour) const;
    [[nodiscard]] bool isRefinedOtherwiseAlong(const TileId& neighbour, Edge edge) const;

    const ChangedArea& _area;
    EdgeDepths& _depths;
    const TileLayout& _layout;
    HadChildren _hadChildren;
};

}  // namespace osgbindem

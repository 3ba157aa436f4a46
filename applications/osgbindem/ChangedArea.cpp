// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ChangedArea.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

bool haveCommonLongitude(const RectDeg& a, const RectDeg& b) noexcept {
    const double turns = std::floor((a.west - b.west) / 360.0);
    for (const double turn : {turns, turns + 1.0}) {
        if (b.west + 360.0 * turn <= a.east && b.east + 360.0 * turn >= a.west) return true;
    }
    return false;
}

}  // namespace

bool ChangedArea::touches(const RectDeg& rect) const noexcept {
    return std::any_of(_rects.begin(), _rects.end(), [&](const RectDeg& changed) {
        if (changed.south > rect.north || changed.north < rect.south) return false;
        const bool isAtPole =
            (changed.north >= 90.0 && rect.north >= 90.0) || (changed.south <= -90.0 && rect.south <= -90.0);
        return isAtPole || haveCommonLongitude(changed, rect);
    });
}

bool ChangedTiles::has(const TileId& tile) const {
    if (hasChangedHeights(tile)) return true;
    return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
        const auto neighbour = tile.neighbour(edge);
        if (!neighbour) return false;
        return isRefinedOtherwiseAbove(*neighbour) || isRefinedOtherwiseAlong(*neighbour, oppositeOf(edge));
    });
}

bool ChangedTiles::hasChangedHeights(const TileId& tile) const {
    int coarsest =
        std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
    for (const Edge edge : kEdges) coarsest = std::min(coarsest, _depths.coarsestAcross(tile, edge));
    return _area.touches(tile.rect().grownBy(_layout.spacingDeg(coarsest)));
}

bool ChangedTiles::isRefinedOtherwise(const TileId& tile) const {
    return _area.touches(tile.rect()) && _depths.hasChildren(tile) != _hadChildren(tile);
}

bool ChangedTiles::isRefinedOtherwiseAbove(const TileId& neighbour) const {
    for (int level = _layout.startLevel(); level <= neighbour.level; ++level) {
        const TileId above = neighbour.ancestor(level);
        if (isRefinedOtherwise(above)) return true;
        if (!_depths.hasChildren(above)) return false;
    }
    return false;
}

bool ChangedTiles::isRefinedOtherwiseAlong(const TileId& neighbour, Edge edge) const {
    if (!_area.touches(neighbour.rect())) return false;
    if (isRefinedOtherwise(neighbour)) return true;
    if (!_depths.hasChildren(neighbour)) return false;
    const std::array<TileId, 2> children = childrenAlong(neighbour, edge);
    return isRefinedOtherwiseAlong(children[0], edge) || isRefinedOtherwiseAlong(children[1], edge);
}

}  // namespace osgbindem

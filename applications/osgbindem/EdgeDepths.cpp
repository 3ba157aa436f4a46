// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "EdgeDepths.h"

#include <algorithm>

namespace osgbindem {

namespace {

// Enough for the neighbourhood of the tiles at work; the answers can be found again.
constexpr std::size_t kMostKnown = 100000;

}  // namespace

Edge oppositeOf(Edge edge) {
    return static_cast<Edge>(static_cast<std::size_t>(edge) ^ 1U);  // they stand in pairs
}

std::array<TileId, 2> childrenAlong(const TileId& tile, Edge edge) {
    const std::array<TileId, 4> all = tile.children();
    const bool isParallel = edge == Edge::South || edge == Edge::North;
    const std::size_t first = edge == Edge::North ? 2 : edge == Edge::East ? 1 : 0;
    return {all[first], all[first + (isParallel ? 1 : 2)]};
}

bool EdgeDepths::hasChildren(const TileId& tile) {
    if (tile.level >= _layout.deepestLevel() || !_layout.isInRegion(tile)) return false;
    if (tile.level < _layout.startLevel()) return true;
    const auto known = _known.find(tile);
    if (known != _known.end()) return known->second;
    const bool result = _mosaic.hasFinerData(tile.rect(), _layout.spacingDeg(tile.level));
    if (_known.size() >= kMostKnown) _known.clear();
    _known.emplace(tile, result);
    return result;
}

int EdgeDepths::coarsestAcross(const TileId& tile, Edge edge) {
    const auto neighbour = tile.neighbour(edge);
    if (!neighbour) return tile.level;
    int level = _layout.startLevel();
    while (level < tile.level && hasChildren(neighbour->ancestor(level))) ++level;
    return level;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HeightPyramid.h"

#include <algorithm>
#include <cassert>

namespace osgAnalyticBin::paper {

namespace {

using core::Interval;

std::size_t side(int level) {
    return std::size_t{1} << level;
}

// Tiles of all levels above.
std::size_t firstOf(int level) {
    return (side(2 * level) - 1) / 3;
}

Interval united(const Interval& a, const Interval& b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

std::size_t startIndex(const TileId& start) {
    return static_cast<std::size_t>(start.y * TileId::kStartColumns + start.x);
}

}  // namespace

HeightPyramid::HeightPyramid(int deepestLevel, const Range& range) : _deepestLevel(deepestLevel) {
    assert(0 <= deepestLevel && deepestLevel <= kDeepest);
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            _startTiles.push_back(build({0, x, y}, range));
        }
    }
}

HeightPyramid::StartTile HeightPyramid::build(const TileId& start, const Range& range) const {
    const Interval whole = range(start);
    if (!(whole.width() > 0.0) || _deepestLevel == 0) return {whole};
    StartTile tiles(firstOf(_deepestLevel + 1));
    const std::size_t deepest = side(_deepestLevel);
    for (std::size_t y = 0; y < deepest; ++y) {
        for (std::size_t x = 0; x < deepest; ++x) {
            const TileId tile{_deepestLevel, (start.x << _deepestLevel) + static_cast<int>(x),
                              (start.y << _deepestLevel) + static_cast<int>(y)};
            tiles[firstOf(_deepestLevel) + y * deepest + x] = range(tile);
        }
    }
    for (int level = _deepestLevel - 1; level >= 0; --level) {
        for (std::size_t y = 0; y < side(level); ++y) {
            for (std::size_t x = 0; x < side(level); ++x) {
                const std::size_t south = firstOf(level + 1) + 2 * y * side(level + 1) + 2 * x;
                const std::size_t north = south + side(level + 1);
                tiles[firstOf(level) + y * side(level) + x] =
                    united(united(tiles[south], tiles[south + 1]), united(tiles[north], tiles[north + 1]));
            }
        }
    }
    return tiles;
}

Interval HeightPyramid::heights(const TileId& tile) const noexcept {
    assert(tile.level <= _deepestLevel);
    const TileId start = tile.ancestor(0);
    const StartTile& tiles = _startTiles[startIndex(start)];
    if (tiles.size() == 1) return tiles.front();
    const auto x = static_cast<std::size_t>(tile.x - (start.x << tile.level));
    const auto y = static_cast<std::size_t>(tile.y - (start.y << tile.level));
    return tiles[firstOf(tile.level) + y * side(tile.level) + x];
}

core::GeodeticBin HeightPyramid::bin(const TileId& tile) const noexcept {
    const osgbindem::RectDeg rect = tile.rect();
    return core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, heights(tile));
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <functional>
#include <vector>

namespace osgAnalyticBin::paper {

using osgbindem::TileId;

/// The lowest and highest altitude of every tile of the quadtree down to a level, found in advance.
/// Source: [JJ] section 4: heights of every block from a pyramid.
class HeightPyramid final {
public:
    static constexpr int kDeepest = 8;

    /// Metres above the ellipsoid within a tile.
    using Range = std::function<core::Interval(const TileId&)>;

    /// Asks `range` for the start tiles and, where a start tile is not flat, for its tiles at the deepest level; the
    /// levels between are united from four children each.
    /// Requires: 0 <= deepestLevel <= kDeepest; the range of a start tile holds those of its descendants.
    HeightPyramid(int deepestLevel, const Range& range);

    [[nodiscard]] int deepestLevel() const noexcept { return _deepestLevel; }

    /// Requires: tile.level <= deepestLevel().
    [[nodiscard]] core::Interval heights(const TileId& tile) const noexcept;

    /// The tile's analytic bin. Requires: as heights().
    [[nodiscard]] core::GeodeticBin bin(const TileId& tile) const noexcept;

private:
    /// Levels one after the other, rows from south to north; a flat start tile has its range alone.
    using StartTile = std::vector<core::Interval>;

    [[nodiscard]] StartTile build(const TileId& start, const Range& range) const;

    int _deepestLevel;
    std::vector<StartTile> _startTiles;
};

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "TileLayout.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <string>
#include <vector>

namespace osgAnalyticBin::paper {

using osgbindem::TileId;

/// The globe that an elevation raster describes; 0 m where it has no data.
class Terrain final {
public:
    static constexpr int kDeepest = 8;

    /// Heights below 0 m, those of the sea's floor, are taken for its surface.
    /// Finds the lowest and highest altitude of every tile down to a level in advance, 0 to kDeepest.
    /// Source: [JJ] section 4: heights of every block from a pyramid.
    /// Throws: osgbindem::Failure when the raster cannot be read.
    Terrain(const std::string& dem, int deepestLevel);

    [[nodiscard]] int deepestLevel() const noexcept { return static_cast<int>(_heights.size()) - 1; }

    /// Metres above the ellipsoid. Requires: tile.level <= deepestLevel().
    [[nodiscard]] const core::Interval& heights(const TileId& tile) const { return _heights[level(tile)][place(tile)]; }

    /// The tile's analytic bin. Requires: as heights().
    [[nodiscard]] core::GeodeticBin bin(const TileId& tile) const;

    [[nodiscard]] const core::Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    /// Where the raster has part; the whole globe for one that goes round it.
    [[nodiscard]] const osgbindem::RectDeg& extent() const noexcept { return _extent; }

    /// Metres above the ellipsoid, bilinear between posts.
    [[nodiscard]] double height(const osgbindem::PositionDeg& position);

    /// The point of the terrain at a latitude and a longitude in radians; the altitude given is not used.
    [[nodiscard]] core::Geodetic onSurface(const core::Geodetic& position);

private:
    [[nodiscard]] static std::size_t level(const TileId& tile) { return static_cast<std::size_t>(tile.level); }
    [[nodiscard]] static std::size_t place(const TileId& tile) {
        return static_cast<std::size_t>(tile.y) * static_cast<std::size_t>(tile.columns()) +
               static_cast<std::size_t>(tile.x);
    }

    core::Interval findHeights(const TileId& tile);

    core::Ellipsoid _ellipsoid;
    osgbindem::DemMosaic _mosaic;
    osgbindem::RectDeg _extent;
    std::vector<std::vector<core::Interval>> _heights;  // of each level, rows from south to north
};

}  // namespace osgAnalyticBin::paper

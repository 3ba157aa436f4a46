// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "TileLayout.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <map>
#include <string>

namespace osgAnalyticBin::paper {

using osgbindem::TileId;

/// The globe that an elevation raster describes; 0 m where it has no data.
class Terrain final {
public:
    static constexpr int kDeepest = 8;

    /// Heights below 0 m, those of the sea's floor, are taken for its surface. `deepestLevel`: 0 to kDeepest.
    /// Throws: osgbindem::Failure when the raster cannot be read.
    Terrain(const std::string& dem, int deepestLevel);

    [[nodiscard]] int deepestLevel() const noexcept { return _deepestLevel; }

    /// The tile's analytic bin, with the altitudes of all tiles of the deepest level in it.
    /// Source: [JJ] section 4: heights of every block from a pyramid.
    /// Cost: all posts of the tile, when it is asked for first.
    [[nodiscard]] const core::GeodeticBin& bin(const TileId& tile);

    [[nodiscard]] const core::Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    /// Where the raster has part; the whole globe for one that goes round it.
    [[nodiscard]] const osgbindem::RectDeg& extent() const noexcept { return _extent; }

    /// Metres above the ellipsoid, bilinear between posts.
    [[nodiscard]] double height(const osgbindem::PositionDeg& position);

    /// The point of the terrain at a latitude and a longitude in radians; the altitude given is not used.
    [[nodiscard]] core::Geodetic onSurface(const core::Geodetic& position);

private:
    core::Ellipsoid _ellipsoid;
    osgbindem::DemMosaic _mosaic;
    osgbindem::RectDeg _extent;
    int _deepestLevel;
    std::map<TileId, core::GeodeticBin> _bins;  // of the tiles that were asked for
};

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileSurface.h>

#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

/// The surface that osgTerrain::GeometryTechnique makes of a tile whose frame is ECEF.
[[nodiscard]] TileSurface terrainTileSurface(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid,
                                             double sampleRatio);

/// The locator by which GeometryTechnique places the tile's vertices. Returns: nullptr when there is none.
[[nodiscard]] const osgTerrain::Locator* masterLocator(osgTerrain::TerrainTile& tile);

/// The height field of a tile, complete. Returns: nullptr when the tile has none, or another kind of elevation layer.
[[nodiscard]] const osg::HeightField* heightField(osgTerrain::TerrainTile& tile);

}  // namespace osgAnalyticBin

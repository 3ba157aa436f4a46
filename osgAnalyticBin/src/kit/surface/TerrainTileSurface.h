// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/TileSurface.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>

#include <osgTerrain/TerrainTile>

#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// Whether the tile is of OSG's own class, and its technique is osgTerrain::GeometryTechnique, or none yet.
[[nodiscard]] bool isDrawnByOsg(const osgTerrain::TerrainTile& tile);

/// The surface that osgTerrain::GeometryTechnique would make of a tile whose frame is ECEF.
[[nodiscard]] TileSurface terrainTileSurface(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid,
                                             double sampleRatio);

/// The posts between which osgTerrain::GeometryTechnique makes triangles, as they are shown.
struct TerrainPosts {
    core::GeodeticGrid grid;
    std::vector<double> altitudes;  ///< metres, row by row from the south-west
    double margin = 0.0;            ///< metres by which vertices may be rounded
    double skirt = 0.0;             ///< metres that skirts hang down
};

/// The posts of a tile whose frame is ECEF. Returns: nullopt where its mesh is not a whole grid of such posts: with
/// posts that are not valid, sampled, or half way to the heights of neighbours; and for other techniques.
[[nodiscard]] std::optional<TerrainPosts> terrainPosts(osgTerrain::TerrainTile& tile,
                                                       const osg::EllipsoidModel& ellipsoid, const TerrainShape& shape);

/// The rectangle that a tile whose frame is ECEF fills by any technique that draws all of it. Returns: nullopt where
/// the tile has posts that are not valid, or stands elsewhere.
[[nodiscard]] std::optional<core::GeodeticBin> terrainExtents(osgTerrain::TerrainTile& tile,
                                                              const osg::EllipsoidModel& ellipsoid);

/// The locator by which GeometryTechnique places the tile's vertices. Returns: nullptr when there is none.
[[nodiscard]] const osgTerrain::Locator* masterLocator(osgTerrain::TerrainTile& tile);

/// The height field of a tile, complete. Returns: nullptr when the tile has none, or another class of elevation layer.
[[nodiscard]] const osg::HeightField* heightField(osgTerrain::TerrainTile& tile);

}  // namespace osgAnalyticBin

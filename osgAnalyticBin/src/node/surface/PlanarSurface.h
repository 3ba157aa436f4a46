// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

/// What one tile of a map draws by itself. All in map units.
struct PlanarSurface {
    osg::BoundingBoxd box;    ///< at vertical scale 1; not valid(): no terrain in a map, or one that cannot be told
    double margin = 0.0;      ///< by which float vertices may leave the box
    double skirt = 0.0;       ///< by which skirts hang below; a mesh's box holds its own already
    double raised = 0.0;      ///< by which skirts of negative height stand up
    bool isScalable = false;  ///< an osgTerrain tile

    void expandBy(const PlanarSurface& other);
};

/// Whether osgTerrain::GeometryTechnique would draw the tile in the plane of a map.
[[nodiscard]] bool isPlanar(osgTerrain::TerrainTile& tile);

/// The surface of an osgTerrain tile, or of any subgraph of fixed transforms and geometry that lies flat.
[[nodiscard]] PlanarSurface planarSurface(osg::Node& node, const osg::Matrixd& localToMap, double sampleRatio);

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/Group>

#include <string>

namespace osgAnalyticBin::tiles {

/// What the grid of a tile is apart from its heights: its size, and its place among the posts of its level.
[[nodiscard]] osgAnalyticBin::TerrainGrid gridWithoutHeights(const TileLayout& layout, const TileId& tile);

/// The lowest and the highest of a tile's own posts.
[[nodiscard]] osgAnalyticBin::core::Interval heightsOf(const osgAnalyticBin::TerrainGrid& grid);

/// Sets the grid's origin to its middle, halfway between its lowest and its highest post. Requires: it has heights.
void placeOrigin(osgAnalyticBin::TerrainGrid& grid, const TileLayout& layout, int level);

/// Makes the root node of a globe, without tiles. Lights take the colours of the vertices. `wkt`: the reference system.
[[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const osgAnalyticBin::core::Ellipsoid& ellipsoid,
                                                               const std::string& wkt);

/// Declares the altitude below which nothing is drawn, so that the globe hides what is behind it. Requires: the tiles
/// below the root have stored bins.
void declareHorizon(osg::Group& root);

/// Puts the geometry at its place on the globe.
[[nodiscard]] osg::ref_ptr<osg::Node> makePlaced(osg::Geometry& geometry, const glm::dvec3& originEcef);

/// What the node of a tile needs to know.
struct TileFacts {
    osgAnalyticBin::AnalyticBin bin;
    /// Metres: the mesh draws nothing lower, skirts left out.
    double surfaceLow;
    const TileLayout& layout;
    double lodFactor;
    /// Of the children, seen from the file that has the tile; empty for a tile without children.
    std::string childrenFile;
};

/// A PagedLOD, or a Group for a tile without children, that carries the bin.
[[nodiscard]] osg::ref_ptr<osg::Node> makeTileNode(const TileId& tile, osg::Node& placed, const TileFacts& facts);

}  // namespace osgAnalyticBin::tiles

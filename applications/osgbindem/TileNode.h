// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Group>

#include <string>

namespace osgbindem {

/// What the grid of a tile is apart from its heights: its size, and its place among the posts of its level.
[[nodiscard]] osgAnalyticBin::TerrainGrid gridWithoutHeights(const TileLayout& layout, const TileId& tile);

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

}  // namespace osgbindem

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
#include <osg/Image>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace osgAnalyticBin::tiles {

/// What the grid of a tile is apart from its heights: its size, and its place among the posts of its level.
[[nodiscard]] TerrainGrid gridWithoutHeights(const TileLayout& layout, const TileId& tile);

/// The lowest and the highest of a tile's own posts.
[[nodiscard]] core::Interval heightsOf(const TerrainGrid& grid);

/// Sets the grid's origin to its middle, halfway between its lowest and its highest post. Requires: it has heights.
void placeOrigin(TerrainGrid& grid, const TileLayout& layout, int level);

/// Makes the root node of a globe, without tiles. Lights take the colours of the vertices. `wkt`: the reference system.
[[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const core::Ellipsoid& ellipsoid,
                                                               const std::string& wkt);

/// Declares the altitude below which nothing is drawn, so that the globe hides what is behind it. Requires: the tiles
/// below the root have stored bins.
void declareHorizon(osg::Group& root);

/// Gives the grid a texture of this size, or the colours of the relief for 0.
void colour(TerrainGrid& grid, int textureSize);

/// The colours that the relief has at the posts of a grid without a texture, row by row from the south-west.
[[nodiscard]] osg::ref_ptr<const osg::Vec4ubArray> reliefColours(TerrainGrid grid);

/// What is stored of a tile, with the image as its texture; the parts that tiles share are added by SharedParts.
/// `isPacked`: the grid in place of the mesh, and the image in blocks (DXT1).
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const TerrainGrid& grid, osg::Image* image, bool isPacked);

/// The tiles of one file share their triangles, and those with textures of one size their texture coordinates.
class SharedParts final {
public:
    /// Those of packed tiles are empty, to be filled when they are read.
    SharedParts(int cells, bool arePacked);

    /// Completes the geometry. `textureSize`: 0 without a texture.
    void addTo(osg::Geometry& geometry, int textureSize);

private:
    osg::ref_ptr<osg::DrawElementsUShort> _triangles;
    int _cells;
    /// By the size of the texture.
    std::map<int, osg::ref_ptr<osg::Vec2Array>> _texCoords;
};

/// Where a mesh lies.
struct MeshExtent {
    AnalyticBin bin;    ///< of everything the mesh draws
    double surfaceLow;  ///< metres; nothing but skirts is lower, the bin's margin apart
};

/// Of the grid's mesh as its float vertices draw it. Guarantee: see MeshBounds; the margin covers vertices at the axis.
[[nodiscard]] MeshExtent extentOf(const TerrainGrid& grid, const std::vector<std::uint16_t>& triangles);

/// Puts the geometry at its place on the globe.
[[nodiscard]] osg::ref_ptr<osg::Node> makePlaced(osg::Geometry& geometry, const glm::dvec3& originEcef);

/// What the node of a tile needs to know.
struct TileFacts {
    AnalyticBin bin;
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

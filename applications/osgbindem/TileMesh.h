// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Image>

#include <cstdint>
#include <map>
#include <vector>

namespace osgbindem {

/// Gives the grid a texture of this size, or the colours of the relief for 0.
void colour(osgAnalyticBin::TerrainGrid& grid, int textureSize);

/// The colours that the relief has at the posts of a grid without a texture, row by row from the south-west.
[[nodiscard]] osg::ref_ptr<const osg::Vec4ubArray> reliefColours(osgAnalyticBin::TerrainGrid grid);

/// What is stored of a tile, with the image as its texture; the parts that tiles share are added by SharedParts.
/// `isPacked`: the grid in place of the mesh, and the image in blocks (DXT1).
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const osgAnalyticBin::TerrainGrid& grid, osg::Image* image,
                                                       bool isPacked);

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
    osgAnalyticBin::AnalyticBin bin;  ///< of everything the mesh draws
    double surfaceLow;                ///< metres; nothing but skirts is lower, the bin's margin apart
};

/// Of the grid's mesh as its float vertices draw it.
/// Guarantee: the bin holds every point of every triangle; the margin covers vertices at the axis, which have no
/// longitude.
[[nodiscard]] MeshExtent extentOf(const osgAnalyticBin::TerrainGrid& grid, const std::vector<std::uint16_t>& triangles,
                                  const TileId& tile);

}  // namespace osgbindem

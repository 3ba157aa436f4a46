// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Image>

#include <cstdint>
#include <map>
#include <vector>

namespace osgAnalyticBin::tiles {

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

}  // namespace osgAnalyticBin::tiles

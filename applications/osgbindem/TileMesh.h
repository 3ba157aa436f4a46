// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "SkirtMeasure.h"
#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Image>

#include <cstdint>
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

/// The tile as it is stored, but for its colours. Heights and skirts are in whole steps; skirts are rounded up.
[[nodiscard]] osgAnalyticBin::TerrainGrid gridOf(const HeightGrid& heights, const Skirt& skirt,
                                                 const TileLayout& layout);

/// Where a mesh lies.
struct MeshExtent {
    osgAnalyticBin::AnalyticBin bin;  ///< of everything the mesh draws
    double surfaceLow;                ///< metres; nothing but skirts is lower, the bin's margin apart
};

/// Of the grid's mesh as its float vertices draw it.
/// Guarantee: the bin holds every point of every triangle; the margin covers vertices at the axis, which have no
/// longitude.
[[nodiscard]] MeshExtent extentOf(const osgAnalyticBin::TerrainGrid& grid, const std::vector<std::uint16_t>& triangles,
                                  const TileId& tile, const TileLayout& layout);

}  // namespace osgbindem

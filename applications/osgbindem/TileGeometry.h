// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TerrainGrid.h>

#include <osg/Geometry>
#include <osg/Image>

namespace osgbindem {

/// Gives the grid a texture of this size, or the colours of the relief for 0.
void colour(osgAnalyticBin::TerrainGrid& grid, int textureSize);

/// The colours that the relief has at the posts of a grid without a texture, row by row from the south-west.
[[nodiscard]] osg::ref_ptr<const osg::Vec4ubArray> reliefColours(osgAnalyticBin::TerrainGrid grid);

/// What is stored of a tile, with the image as its texture; the parts that tiles share are added by SharedParts.
/// `isPacked`: the grid in place of the mesh, and the image in blocks (DXT1).
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const osgAnalyticBin::TerrainGrid& grid, osg::Image* image,
                                                       bool isPacked);

}  // namespace osgbindem

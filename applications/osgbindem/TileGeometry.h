// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TerrainGrid.h>

#include <osg/Geometry>
#include <osg/Image>

namespace osgbindem {

/// Gives the grid the colours of its heights, or those of the image.
void colour(osgAnalyticBin::TerrainGrid& grid, const osg::Image* image);

/// What is stored of a tile, with the image as its texture; the parts that tiles share are added by SharedParts.
/// `isPacked`: the grid in place of the mesh, and the image in blocks (DXT1).
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const osgAnalyticBin::TerrainGrid& grid, osg::Image* image,
                                                       bool isPacked);

}  // namespace osgbindem

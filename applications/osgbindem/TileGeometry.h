// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "TileMesh.h"

#include <osg/Geometry>
#include <osg/Image>

namespace osgbindem {

/// The vertices, normals and colours of a tile; the parts that tiles share are added by SharedParts.
/// With an image the colours are in the texture.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const TileMesh& mesh, const HeightGrid& heights,
                                                       osg::Image* image);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <osg/Node>

namespace osgAnalyticBin {

/// Whether a place lies within the latitudes and longitudes at which the tile or its descendants may draw. Another
/// technique may draw beyond those of the bin, by the margin that the application vouches for. True for a bin that is
/// not valid.
[[nodiscard]] bool isInColumn(const core::Geodetic& place, const AnalyticBinCullCallback& tile,
                              const core::Ellipsoid& ellipsoid);

/// Whether a mesh, a tile's own, is below an eye along the ellipsoid's normal. False in doubt: where the normal meets
/// no triangle, and for terrain tiles that have no mesh yet or whose technique may draw it elsewhere. Cost: a search
/// through the mesh's triangles.
[[nodiscard]] bool isGroundBelow(const core::Geodetic& eye, osg::Node& mesh, const AnalyticBinCullCallback& tile,
                                 const core::Ellipsoid& ellipsoid);

}  // namespace osgAnalyticBin

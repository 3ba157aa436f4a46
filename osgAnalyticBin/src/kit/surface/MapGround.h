// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFrame.h>

namespace osgAnalyticBin {

/// The ground of a tile without a stored bin: the ellipsoid of its frame, or the plane of a map. An osgTerrain
/// tile stands in a map by its locator, whatever is above it; any other mesh by the text of its coordinate system, when
/// it lies flat: a height field over x and y, with heights that terrain has.
/// Returns: nullptr where that cannot be told: above it a map is named and no ellipsoid, but it does not lie flat, or
/// an ellipsoid as well, but it lies flat. Cost: next to nothing, but for meshes below a coordinate system that names a
/// map: one pass over their triangles.
[[nodiscard]] osg::ref_ptr<const osg::EllipsoidModel> groundOf(const FoundTile& tile);

}  // namespace osgAnalyticBin

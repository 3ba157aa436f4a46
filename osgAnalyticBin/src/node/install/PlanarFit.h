// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osg/BoundingBox>

namespace osgAnalyticBin {

/// What a tile of a map is culled by.
struct PlanarFit {
    enum Kind {
        NotPlanar,     ///< says nothing of a map, or does not look like terrain in one
        Planar,        ///< terrain in a map
        Contradictory  ///< lies flat in a map by its looks and its coordinate system's text, but is given an ellipsoid
    };
    Kind kind = NotPlanar;
    /// In map coordinates, at the given vertical scale, with all descendants and all skirts.
    osg::BoundingBoxd box;
    bool isScalable = false;  ///< an osgTerrain tile
};

/// Descendants lie within the tile's extents and the heights that the options declare, in the map's units; their skirts
/// hang no deeper than those of the tile. Undeclared heights hold all terrain on earth in feet.
/// An osgTerrain tile is planar by its locator, whatever is above it; any other mesh by the text of its coordinate
/// system, when it lies flat: a height field over x and y, with heights that terrain has.
/// Cost: one pass over heights or vertices and triangles; next to nothing for tiles that say nothing of a map.
[[nodiscard]] PlanarFit fitPlanarTile(const FoundTile& tile, const CullOptions& options, const TerrainShape& shape);

}  // namespace osgAnalyticBin

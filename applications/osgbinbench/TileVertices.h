// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>

#include <optional>
#include <vector>

namespace osgAnalyticBin::bench {

/// A vertex of a tile on a globe.
struct Vertex {
    glm::dvec3 ecef{0.0};
    core::Geodetic position;
};

/// From the frame in which a cull callback of the tile's node sees the eye to ECEF: a transform's own.
[[nodiscard]] osg::Matrixd callbackFrame(const FoundTile& tile);

/// The vertices of a tile's own meshes, ECEF. Returns: none of a tile of osgTerrain, which has no mesh yet.
[[nodiscard]] std::vector<glm::dvec3> verticesOf(const FoundTile& tile);

/// The surface of a tile.
struct TileSurface {
    std::vector<Vertex> vertices;  ///< without those that hang below others, as those of skirts do
    core::Geodetic middle;         ///< of the latitudes and longitudes of all vertices, on the ellipsoid
};

/// Returns: nullopt without vertices, and where one is a quarter turn from the middle or farther.
[[nodiscard]] std::optional<TileSurface> surfaceOf(const std::vector<glm::dvec3>& verticesEcef,
                                                   const core::Ellipsoid& ellipsoid);

/// The tiles of a file that are on a globe. `pageOf`: for a file that is paged below a globe, its ellipsoid; nullptr
/// for a root file.
[[nodiscard]] std::vector<FoundTile> tilesOnGlobe(osg::Node& graph, const osg::EllipsoidModel* pageOf);

}  // namespace osgAnalyticBin::bench

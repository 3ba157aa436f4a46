// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/Matrixd>

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

[[nodiscard]] std::vector<Vertex> placed(const std::vector<glm::dvec3>& verticesEcef, const core::Ellipsoid& ellipsoid);

/// The middle of the vertices' latitudes and longitudes, on the ellipsoid. Requires: a vertex.
[[nodiscard]] core::Geodetic middleOf(const std::vector<Vertex>& vertices);

/// The ellipsoid's vertical.
[[nodiscard]] glm::dvec3 upAt(const core::Geodetic& position);

/// The vertices that do not hang below others, as those of skirts do. `middle`: as middleOf() gives it.
/// Requires: no vertex a quarter turn from the middle or farther.
[[nodiscard]] std::vector<Vertex> withoutSkirts(const std::vector<Vertex>& vertices, const core::Geodetic& middle);

}  // namespace osgAnalyticBin::bench

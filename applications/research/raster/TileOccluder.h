// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileVertices.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <vector>

namespace osgAnalyticBin::bench {

/// A coarse grid below a tile's surface: each of its nodes stands at the least altitude of the vertices in the cells
/// around it (min-pooling), so that the grid's triangles are nowhere above the tile's mesh.
struct OccluderGrid {
    int cells = 0;           ///< along one edge of the tile
    glm::dvec3 origin{0.0};  ///< ECEF
    /// From west to east, row by row from the south, relative to the origin.
    std::vector<glm::vec3> nodes;
};

/// `surface`: the vertices without those of skirts; `middle`: TileSurface's; `cells`: along one edge.
/// Returns: nullopt where a node has no vertex near.
/// Guarantee: no point of the grid is above the triangles of a mesh on a regular grid in latitude and longitude that
/// it divides; test: TileOccluder.IsNowhereAboveTheMesh.
[[nodiscard]] std::optional<OccluderGrid> occluderOf(const std::vector<Vertex>& surface, const core::Geodetic& middle,
                                                     const core::Ellipsoid& ellipsoid, int cells);

/// The corners of the box along east, north and up that holds a bin; ECEF. Requires: a valid bin.
[[nodiscard]] std::array<glm::dvec3, 8> boxCorners(const AnalyticBin& bin, const core::Ellipsoid& ellipsoid);

}  // namespace osgAnalyticBin::bench

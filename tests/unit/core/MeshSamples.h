// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TriangleSamples.h"

#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace osgAnalyticBin::test {

void addVertex(core::EcefMesh& mesh, const glm::dvec3& v);

/// Moves vertex number `i`.
void moveVertex(core::EcefMesh& mesh, std::size_t i, const glm::dvec3& by);

/// Posts on a grid over the extents, each with its own altitude; diagonals by chance.
[[nodiscard]] core::EcefMesh gridMesh(Random& random, const core::Ellipsoid& ellipsoid,
                                      const core::GeodeticBin& extents, std::uint32_t cells);

/// The triangle whose first index is number `first` of the mesh's.
[[nodiscard]] Triangle triangleAt(const core::EcefMesh& mesh, std::size_t first);

/// By GeodeticMeshBounds.
[[nodiscard]] core::GeodeticBin thoroughBounds(const core::Ellipsoid& ellipsoid, const core::EcefMesh& mesh,
                                               double reference, double axisTolerance);

/// That random points of all triangles are in the bin, but for the allowance.
void expectHolds(Random& random, const core::Ellipsoid& ellipsoid, const core::EcefMesh& mesh,
                 const core::GeodeticBin& bin, double allowance);

/// Where post number `i` of so many over an interval is.
[[nodiscard]] double postAt(const core::Interval& interval, int i, std::size_t posts);

/// The corners of a random cell, south-west, south-east, north-west, north-east, at altitudes within the interval.
/// Those by the edges of the grid come often.
struct GridCell {
    GridCell(Random& random, const core::Ellipsoid& ellipsoid, const core::GeodeticGrid& grid,
             const core::Interval& altitude);

    /// With diagonals either way.
    [[nodiscard]] std::array<Triangle, 4> triangles() const;

    std::array<glm::dvec3, 4> corners;
};

/// The mesh of a grid with skirts of `depth` metres along its border, each post of which has another vertex below.
[[nodiscard]] core::EcefMesh withSkirts(const core::Ellipsoid& ellipsoid, const core::EcefMesh& grid,
                                        std::uint32_t cells, double depth);

/// Plates of a mesh, with what it covers. Otherwise as the constructor of GroundPlates.
[[nodiscard]] core::GroundPlates platesOf(const core::Ellipsoid& ellipsoid, const core::EcefMesh& mesh,
                                          const core::GeodeticBin& extents, double margin = 0.0);

/// As many meshes have it: each triangle has vertices of its own.
[[nodiscard]] core::EcefMesh unmerged(const core::EcefMesh& mesh);

}  // namespace osgAnalyticBin::test

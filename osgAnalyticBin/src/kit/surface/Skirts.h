// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "SurfaceMesh.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// Edges of a mesh, in the order of TileSurface::edgeLow, as bits of MeshSkirts::edges.
enum EdgeBit : std::uint8_t { kSouthEdge = 1, kEastEdge = 2, kNorthEdge = 4, kWestEdge = 8, kSkirtVertex = 16 };

/// The skirts of a mesh.
struct MeshSkirts {
    /// For each vertex: the edges on which it lies, and whether it is the lower one of two at the same place.
    std::vector<std::uint8_t> marks;
    /// Metres, of the deepest.
    double depth = 0.0;
    /// Square metres, of the longest chord of the border that a skirt hangs from.
    double borderChord2 = 0.0;
};

/// Finds skirts as VirtualPlanetBuilder makes them: texture coordinates that run from 0 to 1 over the tile, and at
/// every vertex on its border a second one straight below, all equally deep, which only border vertices are joined to.
/// Folds them up: the lower vertices go to the upper ones, and with them all of the skirts to the border.
/// Returns: no marks, and the mesh unchanged, when it differs from that in any way: skirts, if any, then count as
/// surface.
[[nodiscard]] MeshSkirts foldSkirts(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid);

}  // namespace osgAnalyticBin

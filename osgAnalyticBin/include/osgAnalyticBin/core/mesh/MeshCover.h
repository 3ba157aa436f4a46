// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <array>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::core {

/// Whether a mesh covers a rectangle of latitude and longitude, seen from above.
struct MeshCover {
    /// The largest rectangle that the surface reaches, skirts left out, without altitudes; of a mesh that is closed
    /// around the globe: all latitudes and longitudes. A surface may run over its borders, by a 256th of the rectangle.
    /// Empty: the mesh has no surface that faces up.
    GeodeticBin place;
    /// Whether every line along the ellipsoid's normal in the rectangle meets the surface more often on a front face
    /// than on a back face. At borders along a parallel the surface ends at the chords between its vertices.
    bool isFilled = false;

    /// Edges of triangles, each by two vertices of the mesh.
    using Ends = std::vector<std::array<std::uint32_t, 2>>;
    /// Where the surface ends.
    Ends ends = {};

    /// The share of a rectangle's width by which places that are the same may differ, for the rounding of vertices.
    static constexpr double kTolerance = 1e-6;
    /// Skirts hang within this share of the rectangle's width from its border.
    static constexpr double kSkirtRoom = 1.0 / 256.0;

    /// Of a mesh, where triangles count with their front faces. `error`: metres by which vertices are rounded; it adds
    /// to kTolerance. Steep triangles at the border count as skirts, and cover nothing. In doubt the rectangle is not
    /// filled: where surfaces with a hole overlap, where the mesh holds a pole within, and where it is no terrain.
    /// Guarantee: isFilled as above, for altitudes above minus half the smallest radius of curvature; tests:
    /// MeshCover.*. Source: doc/theory/horizon.md, section 11.
    /// Cost: some 50 nanoseconds for each triangle; its memory is kept from mesh to mesh, by each thread. Requires:
    /// indices within the vertices.
    [[nodiscard]] static MeshCover of(const Ellipsoid& ellipsoid, const EcefMesh& mesh, double error = 0.0);
};

}  // namespace osgAnalyticBin::core

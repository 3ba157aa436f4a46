// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Random terrain in tiles, an eye above it, and the truth about what the eye sees: rays in long double.

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <core/TriangleSamples.h>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::test {

/// A tile of the terrain.
struct GroundTile {
    core::EcefMesh mesh;
    core::GeodeticBin bin;
};

/// Tiles side by side. Where neighbours have different posts their edges differ, and skirts hang from all of them.
struct OcclusionScene {
    /// `hasSpikes`: needles and pits in some scenes.
    explicit OcclusionScene(Random& random, bool hasSpikes = true);

    /// Whether the surface or a skirt is between the eye and the point.
    [[nodiscard]] bool isBlocked(const RealVector& point) const;
    /// A point of the tile's bin, often of its mesh.
    [[nodiscard]] RealVector pointIn(Random& random, const GroundTile& tile) const;
    /// A point on the top of the tile's bin.
    [[nodiscard]] RealVector topOf(Random& random, const GroundTile& tile) const;

    core::Ellipsoid ellipsoid;
    std::vector<GroundTile> tiles;
    std::vector<Triangle> triangles;  // of all tiles, skirts included
    glm::dvec3 eye, forward, up;
};

/// Whether a line from one point to another meets the triangle between them.
[[nodiscard]] bool meets(const Triangle& triangle, const RealVector& from, const RealVector& to);

}  // namespace osgAnalyticBin::test

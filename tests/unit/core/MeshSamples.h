// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

/// A tile of 64 km by 56.
inline const core::GeodeticBin kHills({0.5, 0.51}, {1.0, 1.01}, {-300.0, 2000.0});

struct Triangle {
    glm::dvec3 a, b, c;
};

/// Corners and edges more often than chance has it.
inline RealVector randomPointOf(Random& random, const Triangle& triangle) {
    Real u = random.uniform();
    Real v = random.uniform();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    if (random.chance(0.3)) u = 0;
    if (random.chance(0.3)) v = random.chance(0.5) ? 0 : 1 - u;
    return (1 - u - v) * real(triangle.a) + u * real(triangle.b) + v * real(triangle.c);
}

/// How far a point is outside of the bin, in metres along the coordinate where it is worst.
inline Real distanceOutside(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const RealVector& point) {
    const RealGeodetic at = ecefToGeodetic(ellipsoid, point);
    const Real radius = ellipsoid.equatorialRadius();
    const Real north = std::max(at.latitude - bin.latitude().upper, bin.latitude().lower - at.latitude) * radius;
    const Real above = std::max(at.altitude - bin.altitude().upper, bin.altitude().lower - at.altitude);
    Real east = 0;
    if (!bin.isFullCircle()) {
        const Real fromMiddle = std::remainder(at.longitude - bin.longitude().middle(), 2 * 3.14159265358979323846L);
        const Real rho = std::hypot(point.x, point.y);
        east = (std::abs(fromMiddle) - static_cast<Real>(bin.longitude().width()) / 2) * rho;
    }
    return std::max({north, east, above});
}

void addVertex(core::EcefMesh& mesh, const glm::dvec3& v);

/// Moves vertex number `i`.
void moveVertex(core::EcefMesh& mesh, std::size_t i, const glm::dvec3& by);

/// Up to `size` radians, at the poles often, with altitudes up to `relief` of the smaller radius either way.
[[nodiscard]] core::GeodeticBin randomExtents(Random& random, const core::Ellipsoid& ellipsoid, double size,
                                              double relief);

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

/// Plates of the posts of a mesh that gridMesh() made, as if only they were known.
[[nodiscard]] core::GroundPlates gridPlatesOf(const core::Ellipsoid& ellipsoid, const core::EcefMesh& mesh,
                                              const core::GeodeticBin& extents, std::size_t cells, double margin = 0.0,
                                              double skirt = 0.0);

/// As many meshes have it: each triangle has vertices of its own.
[[nodiscard]] core::EcefMesh unmerged(const core::EcefMesh& mesh);

}  // namespace osgAnalyticBin::test

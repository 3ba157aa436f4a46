// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <gtest/gtest.h>

#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

using core::EcefMesh;
using core::Ellipsoid;
using core::GeodeticBin;
using core::GeodeticGrid;
using core::Interval;

/// A tile of 64 km by 56.
inline const GeodeticBin kHills({0.5, 0.51}, {1.0, 1.01}, {-300.0, 2000.0});

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
inline Real distanceOutside(const Ellipsoid& ellipsoid, const GeodeticBin& bin, const RealVector& point) {
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

inline void addVertex(EcefMesh& mesh, const glm::dvec3& v) {
    mesh.x.push_back(v.x);
    mesh.y.push_back(v.y);
    mesh.z.push_back(v.z);
}

/// Moves vertex number `i`.
inline void moveVertex(EcefMesh& mesh, std::size_t i, const glm::dvec3& by) {
    mesh.x[i] += by.x;
    mesh.y[i] += by.y;
    mesh.z[i] += by.z;
}

/// Up to `size` radians, at the poles often, with altitudes up to `relief` of the smaller radius either way.
[[nodiscard]] inline GeodeticBin randomExtents(Random& random, const Ellipsoid& ellipsoid, double size, double relief) {
    const double height = random.logUniform(1e-5, size);
    const double south = random.chance(0.1)   ? -kHalfPi
                         : random.chance(0.1) ? kHalfPi - height
                                              : random.uniform(-kHalfPi, kHalfPi - height);
    const double west = random.uniform(-kPi, kPi);
    const double low = random.uniform(-relief, relief);
    const double high = random.chance(0.3) ? low : random.uniform(low, relief);
    const double unit = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    return GeodeticBin({south, south + height}, {west, west + height * random.uniform(0.5, 2.0)},
                       {low * unit, high * unit});
}

/// Posts on a grid over the extents, each with its own altitude; diagonals by chance.
[[nodiscard]] inline EcefMesh gridMesh(Random& random, const Ellipsoid& ellipsoid, const GeodeticBin& extents,
                                       std::uint32_t cells) {
    EcefMesh mesh;
    for (std::uint32_t row = 0; row <= cells; ++row) {
        for (std::uint32_t column = 0; column <= cells; ++column) {
            addVertex(mesh, ellipsoid.toEcef({extents.latitude().lower + extents.latitude().width() * row / cells,
                                              extents.longitude().lower + extents.longitude().width() * column / cells,
                                              random.uniform(extents.altitude().lower, extents.altitude().upper)}));
        }
    }
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t a = row * (cells + 1) + column, b = a + 1, c = a + cells + 1, d = c + 1;
            if (random.chance(0.5))
                mesh.triangles.insert(mesh.triangles.end(), {a, b, c, c, b, d});
            else
                mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
        }
    }
    return mesh;
}

/// The triangle whose first index is number `first` of the mesh's.
[[nodiscard]] inline Triangle triangleAt(const EcefMesh& mesh, std::size_t first) {
    return {mesh.vertex(mesh.triangles[first]), mesh.vertex(mesh.triangles[first + 1]),
            mesh.vertex(mesh.triangles[first + 2])};
}

/// By GeodeticMeshBounds.
[[nodiscard]] inline GeodeticBin thoroughBounds(const Ellipsoid& ellipsoid, const EcefMesh& mesh, double reference,
                                                double axisTolerance) {
    core::GeodeticMeshBounds bounds(ellipsoid, reference, axisTolerance);
    for (std::size_t i = 0; i < mesh.size(); ++i) bounds.expandByVertex(mesh.vertex(i));
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Triangle t = triangleAt(mesh, i);
        bounds.expandByTriangle(t.a, t.b, t.c);
    }
    return bounds.bin();
}

/// That random points of all triangles are in the bin, but for the allowance.
inline void expectHolds(Random& random, const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& bin,
                        double allowance) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Triangle triangle = triangleAt(mesh, i);
        for (int k = 0; k < 10; ++k)
            ASSERT_LE(distanceOutside(ellipsoid, bin, randomPointOf(random, triangle)), allowance);
    }
}

/// Where post number `i` of so many over an interval is.
[[nodiscard]] inline double postAt(const Interval& interval, int i, std::size_t posts) {
    return interval.lower + interval.width() * i / static_cast<double>(posts - 1);
}

/// The corners of a random cell, south-west, south-east, north-west, north-east, at altitudes within the interval.
/// Those by the edges of the grid come often.
struct GridCell {
    GridCell(Random& random, const Ellipsoid& ellipsoid, const GeodeticGrid& grid, const Interval& altitude) {
        const auto pick = [&random](std::size_t posts) {
            const int last = static_cast<int>(posts) - 2;
            return random.chance(0.3) ? 0 : random.chance(0.4) ? last : random.integer(0, last);
        };
        const int column = pick(grid.columns);
        const int row = pick(grid.rows);
        for (int i = 0; i < 4; ++i) {
            const double height = random.chance(0.3)   ? altitude.lower
                                  : random.chance(0.3) ? altitude.upper
                                                       : random.uniform(altitude.lower, altitude.upper);
            corners[static_cast<std::size_t>(i)] =
                ellipsoid.toEcef({postAt(grid.latitude, row + i / 2, grid.rows),
                                  postAt(grid.longitude, column + i % 2, grid.columns), height});
        }
    }

    /// With diagonals either way.
    [[nodiscard]] std::array<Triangle, 4> triangles() const {
        const auto& c = corners;
        return {Triangle{c[0], c[1], c[2]}, Triangle{c[1], c[2], c[3]}, Triangle{c[0], c[1], c[3]},
                Triangle{c[0], c[2], c[3]}};
    }

    std::array<glm::dvec3, 4> corners;
};

/// Plates of a mesh, with what it covers. Otherwise as the constructor of GroundPlates.
[[nodiscard]] inline core::GroundPlates platesOf(const Ellipsoid& ellipsoid, const EcefMesh& mesh,
                                                 const GeodeticBin& extents, double margin = 0.0) {
    return {ellipsoid, mesh, core::MeshCover::of(ellipsoid, mesh, margin), extents, margin};
}

/// Plates of the posts of a mesh that gridMesh() made, as if only they were known.
[[nodiscard]] inline core::GroundPlates gridPlatesOf(const Ellipsoid& ellipsoid, const EcefMesh& mesh,
                                                     const GeodeticBin& extents, std::size_t cells, double margin = 0.0,
                                                     double skirt = 0.0) {
    std::vector<double> altitudes;
    for (std::size_t i = 0; i < mesh.size(); ++i) altitudes.push_back(ellipsoid.toGeodetic(mesh.vertex(i)).altitude);
    return {ellipsoid, GeodeticGrid{extents.latitude(), extents.longitude(), cells + 1, cells + 1}, altitudes, margin,
            skirt};
}

/// As many meshes have it: each triangle has vertices of its own.
[[nodiscard]] inline EcefMesh unmerged(const EcefMesh& mesh) {
    EcefMesh result;
    for (const std::uint32_t vertex : mesh.triangles) {
        result.triangles.push_back(static_cast<std::uint32_t>(result.size()));
        addVertex(result, mesh.vertex(vertex));
    }
    return result;
}

/// The mesh of a grid with skirts of `depth` metres along its border, each post of which has another vertex below.
[[nodiscard]] inline EcefMesh withSkirts(const Ellipsoid& ellipsoid, const EcefMesh& grid, std::uint32_t cells,
                                         double depth) {
    EcefMesh mesh = grid;
    const std::uint32_t posts = cells + 1;
    const auto addWall = [&](std::uint32_t from, std::uint32_t step) {
        for (std::uint32_t i = 0; i < posts; ++i) {
            const std::uint32_t top = from + i * step, bottom = static_cast<std::uint32_t>(mesh.size());
            core::Geodetic place = ellipsoid.toGeodetic(grid.vertex(top));
            place.altitude -= depth;
            addVertex(mesh, ellipsoid.toEcef(place));
            if (i > 0)
                for (const std::uint32_t corner : {top - step, bottom - 1, bottom, top - step, bottom, top})
                    mesh.triangles.push_back(corner);
        }
    };
    addWall(0, 1);
    addWall(cells * posts, 1);
    addWall(0, posts);
    addWall(cells, posts);
    return mesh;
}

}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshSamples.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <gtest/gtest.h>

namespace osgAnalyticBin::test {

using core::EcefMesh;
using core::Ellipsoid;
using core::GeodeticBin;
using core::GeodeticGrid;
using core::Interval;

void addVertex(EcefMesh& mesh, const glm::dvec3& v) {
    mesh.x.push_back(v.x);
    mesh.y.push_back(v.y);
    mesh.z.push_back(v.z);
}

void moveVertex(core::EcefMesh& mesh, std::size_t i, const glm::dvec3& by) {
    mesh.x[i] += by.x;
    mesh.y[i] += by.y;
    mesh.z[i] += by.z;
}

GeodeticBin randomExtents(Random& random, const Ellipsoid& ellipsoid, double size, double relief) {
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

EcefMesh gridMesh(Random& random, const Ellipsoid& ellipsoid, const GeodeticBin& extents, std::uint32_t cells) {
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

Triangle triangleAt(const EcefMesh& mesh, std::size_t first) {
    return {mesh.vertex(mesh.triangles[first]), mesh.vertex(mesh.triangles[first + 1]),
            mesh.vertex(mesh.triangles[first + 2])};
}

GeodeticBin thoroughBounds(const Ellipsoid& ellipsoid, const EcefMesh& mesh, double reference, double axisTolerance) {
    core::GeodeticMeshBounds bounds(ellipsoid, reference, axisTolerance);
    for (std::size_t i = 0; i < mesh.size(); ++i) bounds.expandByVertex(mesh.vertex(i));
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Triangle t = triangleAt(mesh, i);
        bounds.expandByTriangle(t.a, t.b, t.c);
    }
    return bounds.bin();
}

void expectHolds(Random& random, const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& bin,
                 double allowance) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const Triangle triangle = triangleAt(mesh, i);
        for (int k = 0; k < 10; ++k)
            ASSERT_LE(distanceOutside(ellipsoid, bin, randomPointOf(random, triangle)), allowance);
    }
}

double postAt(const Interval& interval, int i, std::size_t posts) {
    return interval.lower + interval.width() * i / static_cast<double>(posts - 1);
}

GridCell::GridCell(Random& random, const Ellipsoid& ellipsoid, const GeodeticGrid& grid, const Interval& altitude) {
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

std::array<Triangle, 4> GridCell::triangles() const {
    const auto& c = corners;
    return {Triangle{c[0], c[1], c[2]}, Triangle{c[1], c[2], c[3]}, Triangle{c[0], c[1], c[3]},
            Triangle{c[0], c[2], c[3]}};
}

core::GroundPlates platesOf(const core::Ellipsoid& ellipsoid, const core::EcefMesh& mesh,
                            const core::GeodeticBin& extents, double margin) {
    return {ellipsoid, mesh, core::MeshCover::of(ellipsoid, mesh, margin), extents, margin};
}

core::GroundPlates gridPlatesOf(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& extents,
                                std::size_t cells, double margin, double skirt) {
    std::vector<double> altitudes;
    for (std::size_t i = 0; i < mesh.size(); ++i) altitudes.push_back(ellipsoid.toGeodetic(mesh.vertex(i)).altitude);
    return {ellipsoid, GeodeticGrid{extents.latitude(), extents.longitude(), cells + 1, cells + 1}, altitudes, margin,
            skirt};
}

EcefMesh unmerged(const EcefMesh& mesh) {
    EcefMesh result;
    for (const std::uint32_t vertex : mesh.triangles) {
        result.triangles.push_back(static_cast<std::uint32_t>(result.size()));
        addVertex(result, mesh.vertex(vertex));
    }
    return result;
}

EcefMesh withSkirts(const core::Ellipsoid& ellipsoid, const EcefMesh& grid, std::uint32_t cells, double depth) {
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

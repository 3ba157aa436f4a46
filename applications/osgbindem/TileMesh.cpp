// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileMesh.h"

#include "TileFrame.h"
#include "TileTopology.h"

#include <osgAnalyticBin/core/GeodeticMeshBounds.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

// Vertices at the poles are rounded to within this of the axis, in metres.
constexpr double kAxisTolerance = 1.0;

// Covers the rounding within GeodeticMeshBounds (1e-7 m).
constexpr double kMargin = 1e-6;

glm::dvec3 rounded(const glm::dvec3& point, double quantum) {
    return {std::nearbyint(point.x / quantum) * quantum, std::nearbyint(point.y / quantum) * quantum,
            std::nearbyint(point.z / quantum) * quantum};
}

PostId postOf(const HeightGrid& heights, const TileLayout& layout, int column, int row) {
    PostId post = layout.firstPost(heights.tile(), heights.tile().level);
    post.column += column;
    post.row += row;
    return post;
}

}  // namespace

TileMesh::TileMesh(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout) {
    verticesEcef.reserve(tileVertexCount(layout.cells()));
    normals.reserve(tileVertexCount(layout.cells()));
    addSurface(heights, layout);
    addSkirts(heights, skirt, layout);
    const double quantum = layout.quantum(heights.tile().level);
    for (glm::dvec3& vertex : verticesEcef) vertex = rounded(vertex, quantum);
    placeOrigin(heights, layout);
}

void TileMesh::addSurface(const HeightGrid& heights, const TileLayout& layout) {
    const int cells = layout.cells();
    const int width = cells + 3;
    std::vector<glm::dvec3> points;
    for (int row = -1; row <= cells + 1; ++row) {
        for (int column = -1; column <= cells + 1; ++column) {
            const auto position = layout.geodetic(postOf(heights, layout, column, row), heights.at(column, row));
            points.push_back(layout.ellipsoid().toEcef(position));
        }
    }
    const auto point = [&points, width](int column, int row) -> const glm::dvec3& {
        return points[static_cast<std::size_t>((row + 1) * width + column + 1)];
    };
    const TileId& tile = heights.tile();
    for (int row = 0; row <= cells; ++row) {
        const bool isPole = (tile.y == 0 && row == 0) || (tile.y == tile.rows() - 1 && row == cells);
        for (int column = 0; column <= cells; ++column) {
            verticesEcef.push_back(point(column, row));
            const glm::dvec3 east = point(column + 1, row) - point(column - 1, row);
            const glm::dvec3 north = point(column, row + 1) - point(column, row - 1);
            const glm::dvec3 normal = isPole ? glm::dvec3(0.0, 0.0, row == 0 ? -1.0 : 1.0) : glm::cross(east, north);
            normals.push_back(glm::vec3(glm::normalize(normal)));
        }
    }
}

void TileMesh::addSkirts(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout) {
    const int cells = layout.cells();
    for (const Edge edge : kEdges) {
        const EdgeSkirt& own = skirt[static_cast<std::size_t>(edge)];
        const double outward = edge == Edge::North ? 1.0 : -1.0;
        for (int i = 0; i <= cells; ++i) {
            const std::size_t top = edgeVertex(cells, edge, i);
            const int column = static_cast<int>(top) % (cells + 1);
            const int row = static_cast<int>(top) / (cells + 1);
            const TileFrame frame(layout.geodetic(postOf(heights, layout, column, row), 0.0));
            const std::size_t place = static_cast<std::size_t>(i);
            verticesEcef.push_back(verticesEcef[top] - own.depth[place] * frame.up +
                                   outward * own.lean[place] * frame.north);
            normals.push_back(normals[top]);
        }
    }
}

void TileMesh::placeOrigin(const HeightGrid& heights, const TileLayout& layout) {
    const HeightRange range = heights.range();
    const int half = layout.cells() / 2;
    const PostId middle = postOf(heights, layout, half, half);
    const auto position = layout.geodetic(middle, 0.5 * (range.lower + range.upper));
    originEcef = rounded(layout.ellipsoid().toEcef(position), layout.quantum(heights.tile().level));
}

MeshExtent extentOf(const TileMesh& mesh, const std::vector<std::uint16_t>& triangles, const TileId& tile,
                    const TileLayout& layout) {
    using namespace osgAnalyticBin;
    const RectDeg rect = tile.rect();
    const double axisTolerance = tile.touchesPole() ? kAxisTolerance : 0.0;
    core::GeodeticMeshBounds bounds(layout.ellipsoid(), 0.5 * (rect.west + rect.east) * kRadiansPerDegree,
                                    axisTolerance);
    std::vector<glm::dvec3> drawn;
    drawn.reserve(mesh.verticesEcef.size());
    for (const glm::dvec3& vertex : mesh.verticesEcef) {
        drawn.push_back(mesh.originEcef + glm::dvec3(glm::vec3(vertex - mesh.originEcef)));
    }
    // the surface's vertices come first, and those of the skirts after them
    const auto posts = static_cast<std::size_t>(layout.cells() + 1);
    const std::size_t surfaceEnd = posts * posts;
    const auto expand = [&](bool isSkirt) {
        const std::size_t end = isSkirt ? drawn.size() : surfaceEnd;
        for (std::size_t i = isSkirt ? surfaceEnd : 0; i < end; ++i) bounds.expandByVertex(drawn[i]);
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            const std::size_t last = std::max({triangles[i], triangles[i + 1], triangles[i + 2]});
            if ((last >= surfaceEnd) != isSkirt) continue;
            bounds.expandByTriangle(drawn[triangles[i]], drawn[triangles[i + 1]], drawn[triangles[i + 2]]);
        }
    };
    expand(false);
    const double surfaceLow = bounds.bin().altitude().lower;
    expand(true);
    return {AnalyticBin(bounds.bin(), kMargin + axisTolerance), surfaceLow};
}

}  // namespace osgbindem

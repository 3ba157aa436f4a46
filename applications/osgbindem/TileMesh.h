// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "SkirtMeasure.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace osgbindem {

/// The triangles of a tile with these cells: surface first, then the skirts in the order of kEdges; seen from outside
/// they turn counter-clockwise. The same for every tile.
[[nodiscard]] std::vector<std::uint16_t> tileTriangles(int cells);

/// Number of vertices of a tile: (cells + 1)^2 of the surface, row by row from the south-west, then cells + 1 for the
/// lower end of each skirt.
[[nodiscard]] std::size_t tileVertexCount(int cells) noexcept;

/// The vertex of the surface above each vertex; surface vertices are their own.
[[nodiscard]] std::vector<std::size_t> surfaceVertices(int cells);

/// A tile's vertices and normals in ECEF.
struct TileMesh {
    TileMesh(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout);

    /// The point in ECEF from which vertices are stored as floats; a multiple of the level's quantum.
    glm::dvec3 originEcef{0.0};
    /// Multiples of the level's quantum.
    std::vector<glm::dvec3> verticesEcef;
    std::vector<glm::vec3> normals;

private:
    void addSurface(const HeightGrid& heights, const TileLayout& layout);
    void addSkirts(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout);
    void placeOrigin(const HeightGrid& heights, const TileLayout& layout);
};

/// The bin of everything the mesh draws, as its float vertices draw it.
/// Guarantee: holds every point of every triangle; the margin covers vertices at the axis, which have no longitude.
[[nodiscard]] osgAnalyticBin::AnalyticBin binOf(const TileMesh& mesh, const std::vector<std::uint16_t>& triangles,
                                                const TileId& tile, const TileLayout& layout);

}  // namespace osgbindem

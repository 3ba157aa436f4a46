// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <cstddef>
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

/// The surface vertex at a place along an edge, counted eastward or northward.
[[nodiscard]] std::size_t edgeVertex(int cells, Edge edge, int along) noexcept;

}  // namespace osgbindem

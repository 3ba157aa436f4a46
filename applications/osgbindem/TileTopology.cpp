// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTopology.h"

#include <osgAnalyticBin/TerrainGrid.h>

namespace osgbindem {

namespace {

std::size_t surfaceIndex(int cells, int column, int row) {
    return static_cast<std::size_t>(row * (cells + 1) + column);
}

}  // namespace

std::size_t edgeVertex(int cells, Edge edge, int along) noexcept {
    switch (edge) {
        case Edge::South:
            return surfaceIndex(cells, along, 0);
        case Edge::North:
            return surfaceIndex(cells, along, cells);
        case Edge::West:
            return surfaceIndex(cells, 0, along);
        case Edge::East:
            break;
    }
    return surfaceIndex(cells, cells, along);
}

std::size_t tileVertexCount(int cells) noexcept {
    return static_cast<std::size_t>((cells + 1) * (cells + 5));
}

std::vector<std::size_t> surfaceVertices(int cells) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < surfaceIndex(cells, 0, cells + 1); ++i) result.push_back(i);
    for (const Edge edge : kEdges) {
        for (int along = 0; along <= cells; ++along) result.push_back(edgeVertex(cells, edge, along));
    }
    return result;
}

std::vector<std::uint16_t> tileTriangles(int cells) {
    return osgAnalyticBin::trianglesOf(cells);
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTopology.h"

namespace osgbindem {

namespace {

std::size_t surfaceIndex(int cells, int column, int row) {
    return static_cast<std::size_t>(row * (cells + 1) + column);
}

std::size_t skirtIndex(int cells, Edge edge, int along) {
    return static_cast<std::size_t>((cells + 1) * (cells + 1) + static_cast<int>(edge) * (cells + 1) + along);
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
    std::vector<std::uint16_t> indices;
    const auto add = [&indices](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t i : {a, b, c}) indices.push_back(static_cast<std::uint16_t>(i));
    };
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const std::size_t southWest = surfaceIndex(cells, column, row);
            const std::size_t southEast = surfaceIndex(cells, column + 1, row);
            const std::size_t northWest = surfaceIndex(cells, column, row + 1);
            const std::size_t northEast = surfaceIndex(cells, column + 1, row + 1);
            add(southWest, southEast, northEast);
            add(southWest, northEast, northWest);
        }
    }
    for (const Edge edge : kEdges) {
        const bool runsRight = edge == Edge::South || edge == Edge::East;  // as seen from outside the tile
        for (int i = 0; i < cells; ++i) {
            const int left = runsRight ? i : i + 1;
            const int right = runsRight ? i + 1 : i;
            add(skirtIndex(cells, edge, left), skirtIndex(cells, edge, right), edgeVertex(cells, edge, right));
            add(skirtIndex(cells, edge, left), edgeVertex(cells, edge, right), edgeVertex(cells, edge, left));
        }
    }
    return indices;
}

}  // namespace osgbindem

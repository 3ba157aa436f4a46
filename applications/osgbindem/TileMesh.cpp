// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileMesh.h"

#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

using osgAnalyticBin::TerrainGrid;

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

// Vertices at the poles are rounded to within this of the axis, in metres.
constexpr double kAxisTolerance = 1.0;

// Covers the rounding within GeodeticMeshBounds (1e-7 m).
constexpr double kMargin = 1e-6;

double rounded(double value, double quantum) {
    return std::nearbyint(value / quantum) * quantum;
}

std::vector<std::int32_t> stepsUp(const std::vector<double>& metres) {
    std::vector<std::int32_t> steps;
    for (const double value : metres) steps.push_back(static_cast<std::int32_t>(std::ceil(value / TerrainGrid::kStep)));
    return steps;
}

glm::dvec3 originOf(const HeightGrid& heights, const TileLayout& layout) {
    PostId middle = layout.firstPost(heights.tile(), heights.tile().level);
    middle.column += layout.cells() / 2;
    middle.row += layout.cells() / 2;
    const HeightRange range = heights.range();
    const glm::dvec3 point = layout.ellipsoid().toEcef(layout.geodetic(middle, 0.5 * (range.lower + range.upper)));
    const double quantum = layout.quantum(heights.tile().level);
    return {rounded(point.x, quantum), rounded(point.y, quantum), rounded(point.z, quantum)};
}

/// Finds which vertices and triangles of the surface can be at an end of the bin. All others are well within: in
/// latitude and longitude those that do not stand at the border, whose neighbours are a whole cell away, and in
/// altitude those that are higher than the lowest post by more than chords sag, and lower than the highest.
class Extremes {
public:
    Extremes(const TerrainGrid& grid, const RectDeg& rect) : _grid(grid) {
        const auto posts = static_cast<std::size_t>(grid.cells + 1);
        for (int row = 0; row <= grid.cells; ++row)
            for (int column = 0; column <= grid.cells; ++column) _range.include(grid.height(column, row));
        const double reach = std::max(std::abs(_range.lower), std::abs(_range.upper));
        const osgAnalyticBin::core::GeodeticGridBounds bounds(
            grid.ellipsoid,
            {{rect.south * kRadiansPerDegree, rect.north * kRadiansPerDegree},
             {rect.west * kRadiansPerDegree, rect.east * kRadiansPerDegree},
             posts,
             posts},
            reach);
        // vertices are rounded by less than a quantum; bounds of triangles are a little deeper than these sag
        _rounding = 2.0 * grid.quantum;
        _sag = 1.5 * bounds.sag() + _rounding;
    }

    [[nodiscard]] bool hasVertex(int column, int row) const {
        const double height = _grid.height(column, row);
        return column == 0 || row == 0 || column == _grid.cells || row == _grid.cells ||
               height <= _range.lower + _rounding || height >= _range.upper - _rounding;
    }

    /// Either triangle of a cell.
    [[nodiscard]] bool hasCell(int column, int row) const {
        const double lowest = std::min(std::min(_grid.height(column, row), _grid.height(column + 1, row)),
                                       std::min(_grid.height(column, row + 1), _grid.height(column + 1, row + 1)));
        return row == 0 || row == _grid.cells - 1 || lowest <= _range.lower + _sag;
    }

private:
    const TerrainGrid& _grid;
    HeightRange _range;
    double _rounding;
    double _sag;
};

}  // namespace

TerrainGrid gridOf(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout) {
    const int level = heights.tile().level;
    TerrainGrid grid;
    grid.ellipsoid = layout.ellipsoid();
    grid.cells = layout.cells();
    grid.columns = static_cast<std::int64_t>(TileId::kStartColumns * layout.cells()) << level;
    const PostId first = layout.firstPost(heights.tile(), level);
    grid.firstColumn = first.column;
    grid.firstRow = first.row;
    grid.quantum = layout.quantum(level);
    grid.origin = originOf(heights, layout);
    grid.heights.reserve(static_cast<std::size_t>((grid.cells + 3) * (grid.cells + 3)));
    for (int row = -1; row <= grid.cells + 1; ++row)
        for (int column = -1; column <= grid.cells + 1; ++column)
            grid.heights.push_back(
                static_cast<std::int32_t>(std::nearbyint(heights.at(column, row) / TerrainGrid::kStep)));
    for (std::size_t edge = 0; edge < kEdges.size(); ++edge)
        grid.skirts[edge] = {stepsUp(skirt[edge].depth), stepsUp(skirt[edge].lean)};
    return grid;
}

MeshExtent extentOf(const TerrainGrid& grid, const std::vector<std::uint16_t>& triangles, const TileId& tile,
                    const TileLayout& layout) {
    using namespace osgAnalyticBin;
    const RectDeg rect = tile.rect();
    const double axisTolerance = tile.touchesPole() ? kAxisTolerance : 0.0;
    core::GeodeticMeshBounds bounds(layout.ellipsoid(), 0.5 * (rect.west + rect.east) * kRadiansPerDegree,
                                    axisTolerance);
    std::vector<glm::dvec3> drawn = verticesOf(grid);
    for (glm::dvec3& vertex : drawn) vertex = grid.origin + glm::dvec3(glm::vec3(vertex - grid.origin));
    const auto expandByTriangle = [&](std::size_t first) {
        bounds.expandByTriangle(drawn[triangles[first]], drawn[triangles[first + 1]], drawn[triangles[first + 2]]);
    };
    const Extremes extremes(grid, rect);
    std::size_t vertex = 0;
    for (int row = 0; row <= grid.cells; ++row)
        for (int column = 0; column <= grid.cells; ++column, ++vertex)
            if (extremes.hasVertex(column, row)) bounds.expandByVertex(drawn[vertex]);
    std::size_t index = 0;
    for (int row = 0; row < grid.cells; ++row) {
        for (int column = 0; column < grid.cells; ++column, index += 6) {
            if (!extremes.hasCell(column, row)) continue;
            expandByTriangle(index);
            expandByTriangle(index + 3);
        }
    }
    const double surfaceLow = bounds.bin().altitude().lower;
    for (; vertex < drawn.size(); ++vertex) bounds.expandByVertex(drawn[vertex]);
    for (; index + 2 < triangles.size(); index += 3) expandByTriangle(index);
    return {AnalyticBin(bounds.bin(), kMargin + axisTolerance), surfaceLow};
}

}  // namespace osgbindem

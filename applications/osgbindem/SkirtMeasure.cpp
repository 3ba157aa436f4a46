// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SkirtMeasure.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgbindem {

using osgAnalyticBin::TerrainGrid;

namespace {

// Enough for the neighbourhood of the tiles at work; the answers can be found again.
constexpr std::size_t kMostKnown = 100000;

}  // namespace

bool SkirtMeasure::hasChildren(const TileId& tile) {
    if (tile.level >= _layout.deepestLevel() || !_layout.isInRegion(tile)) return false;
    if (tile.level < _layout.startLevel()) return true;
    const auto known = _known.find(tile);
    if (known != _known.end()) return known->second;
    const bool result = _mosaic.hasFinerData(tile.rect(), _layout.spacingDeg(tile.level));
    if (_known.size() >= kMostKnown) _known.clear();
    _known.emplace(tile, result);
    return result;
}

int SkirtMeasure::coarsestAcross(const TileId& tile, Edge edge) {
    const auto neighbour = tile.neighbour(edge);
    if (!neighbour) return tile.level;
    int level = _layout.startLevel();
    while (level < tile.level && hasChildren(neighbour->ancestor(level))) ++level;
    return level;
}

/// One edge of a tile as its posts in space.
struct SkirtMeasure::Line {
    Edge edge;
    TileId tile;
    /// The edge's first post, in the grid of the tile's level.
    PostId first;
    std::vector<glm::dvec3> points;
    std::vector<double> heights;

    [[nodiscard]] bool isParallel() const { return edge == Edge::South || edge == Edge::North; }
    /// The post at a distance along the edge, counted in posts of its level.
    [[nodiscard]] PostId post(int level, std::int64_t along, std::int64_t across) const {
        return isParallel() ? PostId{level, along, across} : PostId{level, across, along};
    }
    /// The tile at a place along the edge, counted from its first post, on the own tile's side.
    [[nodiscard]] TileId tileAt(int level, std::int64_t place) const {
        const int shift = level - tile.level;
        const int last = (1 << shift) - 1;
        TileId found{level, tile.x << shift, tile.y << shift};
        (isParallel() ? found.x : found.y) += static_cast<int>(place);
        if (edge == Edge::North) found.y += last;
        if (edge == Edge::East) found.x += last;
        return found;
    }
    [[nodiscard]] std::int64_t along() const { return isParallel() ? first.column : first.row; }
    [[nodiscard]] std::int64_t across() const { return isParallel() ? first.row : first.column; }
};

namespace {

// A drop that is no small part of the relief between two posts: there the skirt ends level at the lowest point of the
// finer edges instead of hanging down by the drop from both posts, which would be far below the ground at the lower
// one.
constexpr double kCliff = 0.25;

void raise(double& value, double candidate) {
    value = std::max(value, candidate);
}

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double share) {
    return a + share * (b - a);
}

/// How far a point of the own polyline is above the other one, and how far it falls short of it outward.
struct Gap {
    double drop;
    double reach;
};

Gap gapBetween(const glm::dvec3& own, const glm::dvec3& other, const PostId& post, const TileLayout& layout,
               Edge edge) {
    const auto [latitude, longitude, altitude] = layout.geodetic(post, 0.0);
    const glm::dvec3 up = layout.ellipsoid().up(latitude, longitude);
    const glm::dvec3 north{-up.z * std::cos(longitude), -up.z * std::sin(longitude), std::cos(latitude)};
    const glm::dvec3 way = other - own;
    const double outward = edge == Edge::North ? 1.0 : edge == Edge::South ? -1.0 : 0.0;
    return {-glm::dot(way, up), outward * glm::dot(way, north)};
}

PostId firstPostOf(const TileId& tile, const TileLayout& layout, Edge edge) {
    PostId post = layout.firstPost(tile, tile.level);
    if (edge == Edge::North) post.row += layout.cells();
    if (edge == Edge::East) post.column += layout.cells();
    return post;
}

}  // namespace

glm::dvec3 SkirtMeasure::ecef(const PostId& post) {
    return _layout.ellipsoid().toEcef(_layout.geodetic(post, _mosaic.height(_layout.position(post))));
}

void SkirtMeasure::measure(const TileId& tile, TerrainGrid& grid) {
    const auto stepsUp = [](const std::vector<double>& metres) {
        std::vector<std::int32_t> steps;
        for (const double value : metres)
            steps.push_back(static_cast<std::int32_t>(std::ceil(value / TerrainGrid::kStep)));
        return steps;
    };
    for (const Edge edge : kEdges) {
        const EdgeSkirt skirt = measureEdge(tile, grid, edge);
        grid.skirts[static_cast<std::size_t>(edge)] = {stepsUp(skirt.depth), stepsUp(skirt.lean)};
    }
}

SkirtMeasure::EdgeSkirt SkirtMeasure::measureEdge(const TileId& tile, const TerrainGrid& grid, Edge edge) {
    const std::size_t count = static_cast<std::size_t>(_layout.posts());
    EdgeSkirt skirt{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
    if (!tile.neighbour(edge)) return skirt;  // a pole: the edge is one point

    Line own{edge, tile, firstPostOf(tile, _layout, edge), {}, {}};
    for (int i = 0; i < _layout.posts(); ++i) {
        const PostId post = own.post(tile.level, own.along() + i, own.across());
        own.heights.push_back(
            grid.height(static_cast<int>(post.column - grid.firstColumn), static_cast<int>(post.row - grid.firstRow)));
        own.points.push_back(_layout.ellipsoid().toEcef(_layout.geodetic(post, own.heights.back())));
    }
    compareWithFiner(own, skirt);
    const int coarsest = std::max(_layout.startLevel(), std::min(tile.level - 1, coarsestAcross(tile, edge)));
    for (int level = tile.level - 1; level >= coarsest; --level) compareWithCoarser(own, level, skirt);

    // Vertices are rounded to the quantum of their level, the coarsest most, and heights to whole steps; the factor
    // covers the bend between compared points.
    constexpr double kFactor = 1.05;
    const double safety = 2.0 * _layout.quantum(coarsest) + TerrainGrid::kStep;
    for (double& depth : skirt.depth) depth = kFactor * depth + safety;
    for (double& lean : skirt.lean) lean *= kFactor;
    return skirt;
}

void SkirtMeasure::addFiner(const Line& own, int level, std::int64_t place, Segments& segments) {
    const TileId tile = own.tileAt(level, place);
    const auto other = tile.neighbour(own.edge);
    if (!hasChildren(tile) && !(other && hasChildren(*other))) return;
    const int shift = level + 1 - own.tile.level;
    const std::int64_t parts = std::int64_t{1} << shift;
    const std::int64_t posts = std::int64_t{2} * _layout.cells();
    // Even posts belong to the levels between, which are compared by themselves.
    for (std::int64_t along = place * posts + 1; along < (place + 1) * posts; along += 2) {
        const auto i = static_cast<std::size_t>(along >> shift);
        const double ends = std::min(own.heights[i], own.heights[i + 1]);
        Segment& segment = segments.try_emplace({level, i}, Segment{0.0, 0.0, ends}).first->second;
        const PostId post = own.post(level + 1, (own.along() << shift) + along, own.across() << shift);
        const double share = static_cast<double>(along % parts) / static_cast<double>(parts);
        const double height = _mosaic.height(_layout.position(post));
        const Gap gap = gapBetween(between(own.points[i], own.points[i + 1], share),
                                   _layout.ellipsoid().toEcef(_layout.geodetic(post, height)), post, _layout, own.edge);
        raise(segment.drop, gap.drop);
        raise(segment.lean, gap.reach);
        segment.lowest = std::min(segment.lowest, height);
    }
    for (const std::int64_t child : {2 * place, 2 * place + 1}) addFiner(own, level + 1, child, segments);
}

void SkirtMeasure::compareWithFiner(const Line& own, EdgeSkirt& skirt) {
    Segments segments;
    addFiner(own, own.tile.level, 0, segments);
    for (const auto& [levelAndPlace, segment] : segments) {
        const std::size_t i = levelAndPlace.second;
        const std::array<double, 2> ends{own.heights[i], own.heights[i + 1]};
        const bool isCliff = segment.drop > kCliff * std::abs(ends[1] - ends[0]) &&
                             segment.lowest > std::min(ends[0], ends[1]) - segment.drop;
        for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
            raise(skirt.depth[i + end], isCliff ? ends[end] - segment.lowest : segment.drop);
            raise(skirt.lean[i + end], segment.lean);
        }
    }
}

void SkirtMeasure::compareWithCoarser(const Line& own, int level, EdgeSkirt& skirt) {
    const int shift = own.tile.level - level;
    const std::int64_t parts = std::int64_t{1} << shift;
    for (std::size_t i = 0; i < own.points.size(); ++i) {
        const std::int64_t along = own.along() + static_cast<std::int64_t>(i);
        const std::int64_t part = along % parts;
        if (part == 0) continue;
        const glm::dvec3 a = ecef(own.post(level, along >> shift, own.across() >> shift));
        const glm::dvec3 b = ecef(own.post(level, (along >> shift) + 1, own.across() >> shift));
        const PostId post = own.post(own.tile.level, along, own.across());
        const Gap gap = gapBetween(own.points[i], between(a, b, static_cast<double>(part) / static_cast<double>(parts)),
                                   post, _layout, own.edge);
        raise(skirt.depth[i], gap.drop);
        raise(skirt.lean[i], gap.reach);
    }
}

}  // namespace osgbindem

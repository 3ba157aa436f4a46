// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SkirtMeasure.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::TerrainGrid;

bool SkirtMeasure::hasChildren(const TileId& tile) {
    if (tile.level >= _layout.deepestLevel() || !_layout.isInRegion(tile)) return false;
    if (tile.level < _layout.startLevel()) return true;
    // Enough for the neighbourhood of the tiles at work; the answers can be found again.
    constexpr std::size_t kMostKnown = 100000;
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

namespace {

/// How far the polyline of an edge is above other ones, and how far it falls short of them outward.
struct Gap {
    double drop = 0.0;
    double lean = 0.0;

    void expandBy(const Gap& other) {
        drop = std::max(drop, other.drop);
        lean = std::max(lean, other.lean);
    }
};

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double share) {
    return a + share * (b - a);
}

/// One edge of a tile as its posts in space, south to north or west to east, and the gap below each of them.
class EdgeLine final {
public:
    EdgeLine(SkirtMeasure& tiles, DemMosaic& mosaic, const TileLayout& layout, const TileId& tile, Edge edge,
             const TerrainGrid& grid)
        : _tiles(tiles),
          _mosaic(mosaic),
          _layout(layout),
          _tile(tile),
          _edge(edge),
          _isParallel(edge == Edge::South || edge == Edge::North),
          _gaps(static_cast<std::size_t>(layout.posts())) {
        PostId first = layout.firstPost(tile, tile.level);
        if (edge == Edge::North) first.row += layout.cells();
        if (edge == Edge::East) first.column += layout.cells();
        _along = _isParallel ? first.column : first.row;
        _across = _isParallel ? first.row : first.column;
        for (int i = 0; i < layout.posts(); ++i) {
            const PostId own = post(tile.level, _along + i, _across);
            _heights.push_back(grid.height(static_cast<int>(own.column - grid.firstColumn),
                                           static_cast<int>(own.row - grid.firstRow)));
            _points.push_back(ecef(own, _heights.back()));
        }
    }

    [[nodiscard]] const std::vector<Gap>& gaps() const { return _gaps; }

    /// With all levels of tiles that stand along the edge, and only where they do.
    void compareWithFiner() {
        // A drop that is no small part of the relief between two posts: there the skirt ends level at the lowest point
        // of the finer edges instead of hanging down by the drop from both posts, which would be far below the ground
        // at the lower one.
        constexpr double kCliff = 0.25;
        Segments segments;
        addFiner(_tile.level, 0, segments);
        for (const auto& [levelAndPlace, segment] : segments) {
            const std::size_t i = levelAndPlace.second;
            const double drop = segment.gap.drop;
            const bool isCliff = drop > kCliff * std::abs(_heights[i + 1] - _heights[i]) &&
                                 segment.lowest > std::min(_heights[i], _heights[i + 1]) - drop;
            for (const std::size_t end : {i, i + 1})
                _gaps[end].expandBy({isCliff ? _heights[end] - segment.lowest : drop, segment.gap.lean});
        }
    }

    void compareWithCoarser(int level) {
        const int shift = _tile.level - level;
        const std::int64_t parts = std::int64_t{1} << shift;
        for (std::size_t i = 0; i < _points.size(); ++i) {
            const std::int64_t along = _along + static_cast<std::int64_t>(i);
            const std::int64_t part = along % parts;
            if (part == 0) continue;
            const PostId before = post(level, along >> shift, _across >> shift);
            const PostId after = post(level, (along >> shift) + 1, _across >> shift);
            const glm::dvec3 other =
                between(ecef(before, heightAt(before)), ecef(after, heightAt(after)), shareOf(part, parts));
            _gaps[i].expandBy(gapBetween(_points[i], other, post(_tile.level, along, _across)));
        }
    }

private:
    /// What finer posts between two posts of the edge are below the chord.
    struct Segment {
        Gap gap;
        double lowest;
    };
    /// By level and first post.
    using Segments = std::map<std::pair<int, std::size_t>, Segment>;

    [[nodiscard]] static double shareOf(std::int64_t part, std::int64_t parts) {
        return static_cast<double>(part) / static_cast<double>(parts);
    }
    /// The post at a distance along the edge, counted in posts of its level.
    [[nodiscard]] PostId post(int level, std::int64_t along, std::int64_t across) const {
        return _isParallel ? PostId{level, along, across} : PostId{level, across, along};
    }
    /// The tile at a place along the edge, counted from its first post, on the own tile's side.
    [[nodiscard]] TileId tileAt(int level, std::int64_t place) const {
        const int shift = level - _tile.level;
        const int last = (1 << shift) - 1;
        TileId found{level, _tile.x << shift, _tile.y << shift};
        (_isParallel ? found.x : found.y) += static_cast<int>(place);
        if (_edge == Edge::North) found.y += last;
        if (_edge == Edge::East) found.x += last;
        return found;
    }
    [[nodiscard]] double heightAt(const PostId& post) const { return _mosaic.height(_layout.position(post)); }
    [[nodiscard]] glm::dvec3 ecef(const PostId& post, double height) const {
        return _layout.ellipsoid().toEcef(_layout.geodetic(post, height));
    }
    [[nodiscard]] Gap gapBetween(const glm::dvec3& own, const glm::dvec3& other, const PostId& post) const {
        const auto [latitude, longitude, altitude] = _layout.geodetic(post, 0.0);
        const glm::dvec3 up = _layout.ellipsoid().up(latitude, longitude);
        const glm::dvec3 north{-up.z * std::cos(longitude), -up.z * std::sin(longitude), std::cos(latitude)};
        const glm::dvec3 way = other - own;
        const double outward = _edge == Edge::North ? 1.0 : _edge == Edge::South ? -1.0 : 0.0;
        return {-glm::dot(way, up), outward * glm::dot(way, north)};
    }

    /// The tiles below those at a place along the edge, see tileAt().
    void addFiner(int level, std::int64_t place, Segments& segments) const {
        const TileId tile = tileAt(level, place);
        const auto other = tile.neighbour(_edge);
        if (!_tiles.hasChildren(tile) && !(other && _tiles.hasChildren(*other))) return;
        const int shift = level + 1 - _tile.level;
        const std::int64_t parts = std::int64_t{1} << shift;
        const std::int64_t posts = std::int64_t{2} * _layout.cells();
        // Even posts belong to the levels between, which are compared by themselves.
        for (std::int64_t along = place * posts + 1; along < (place + 1) * posts; along += 2) {
            const auto i = static_cast<std::size_t>(along >> shift);
            const double lowest = std::min(_heights[i], _heights[i + 1]);
            Segment& segment = segments.try_emplace({level, i}, Segment{{}, lowest}).first->second;
            const PostId finer = post(level + 1, (_along << shift) + along, _across << shift);
            const double height = heightAt(finer);
            const glm::dvec3 own = between(_points[i], _points[i + 1], shareOf(along % parts, parts));
            segment.gap.expandBy(gapBetween(own, ecef(finer, height), finer));
            segment.lowest = std::min(segment.lowest, height);
        }
        for (const std::int64_t child : {2 * place, 2 * place + 1}) addFiner(level + 1, child, segments);
    }

    SkirtMeasure& _tiles;
    DemMosaic& _mosaic;
    const TileLayout& _layout;
    TileId _tile;
    Edge _edge;
    /// Or a meridian.
    bool _isParallel;
    /// The first post, in the grid of the tile's level.
    std::int64_t _along = 0;
    std::int64_t _across = 0;
    std::vector<glm::dvec3> _points;
    std::vector<double> _heights;
    std::vector<Gap> _gaps;
};

std::int32_t stepsUp(double metres) {
    return static_cast<std::int32_t>(std::ceil(metres / TerrainGrid::kStep));
}

}  // namespace

void SkirtMeasure::measure(const TileId& tile, TerrainGrid& grid) {
    for (const Edge edge : kEdges) {
        TerrainGrid::Skirt& skirt = grid.skirts[static_cast<std::size_t>(edge)];
        skirt.depth.assign(static_cast<std::size_t>(_layout.posts()), 0);
        skirt.lean = skirt.depth;
        if (!tile.neighbour(edge)) continue;  // a pole: the edge is one point

        EdgeLine own(*this, _mosaic, _layout, tile, edge, grid);
        own.compareWithFiner();
        const int coarsest = std::max(_layout.startLevel(), std::min(tile.level - 1, coarsestAcross(tile, edge)));
        for (int level = tile.level - 1; level >= coarsest; --level) own.compareWithCoarser(level);

        // Vertices are rounded to the quantum of their level, the coarsest most, and heights to whole steps; the factor
        // covers the bend between compared points.
        constexpr double kFactor = 1.05;
        const double safety = 2.0 * _layout.quantum(coarsest) + TerrainGrid::kStep;
        for (std::size_t i = 0; i < skirt.depth.size(); ++i) {
            skirt.depth[i] = stepsUp(kFactor * own.gaps()[i].drop + safety);
            skirt.lean[i] = stepsUp(kFactor * own.gaps()[i].lean);
        }
    }
}

}  // namespace osgbindem

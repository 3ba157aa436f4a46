// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgAnalyticBin::tiles {

struct PositionDeg {
    double latitudeDeg = 0.0;
    double longitudeDeg = 0.0;
};

struct RectDeg {
    double west = 0.0;
    double south = 0.0;
    double east = 0.0;
    double north = 0.0;

    /// The same rectangle with a border on all sides, cut at the poles.
    [[nodiscard]] RectDeg grownBy(double borderDeg) const noexcept {
        return {west - borderDeg, std::max(south - borderDeg, -90.0), east + borderDeg,
                std::min(north + borderDeg, 90.0)};
    }

    /// The same area, moved by whole turns so that it lies next to the other one.
    [[nodiscard]] RectDeg turnedTo(const RectDeg& other) const noexcept {
        const double turn = 360.0 * std::round((0.5 * (other.west + other.east) - 0.5 * (west + east)) / 360.0);
        return {west + turn, south, east + turn, north};
    }

    /// The area in square degrees that the rectangles have in common, longitudes modulo 360.
    [[nodiscard]] double overlap(const RectDeg& other) const noexcept {
        const double height = std::min(north, other.north) - std::max(south, other.south);
        double width = 0.0;
        for (const double turn : {-720.0, -360.0, 0.0, 360.0, 720.0})
            width += std::max(0.0, std::min(east + turn, other.east) - std::max(west + turn, other.west));
        return width * std::max(0.0, height);
    }
};

/// The edges of a tile, in the order in which everything that has four of them keeps them.
enum class Edge : std::size_t { South, North, West, East };
inline constexpr std::array<Edge, 4> kEdges{Edge::South, Edge::North, Edge::West, Edge::East};

/// Name of a tile: x counts eastward from -180 degrees, y northward from -90.
struct TileId {
    int level = 0;
    int x = 0;
    int y = 0;

    static constexpr int kStartColumns = 16;
    static constexpr int kStartRows = 8;

    [[nodiscard]] int columns() const noexcept { return kStartColumns << level; }
    [[nodiscard]] int rows() const noexcept { return kStartRows << level; }

    /// South-west, south-east, north-west, north-east.
    [[nodiscard]] std::array<TileId, 4> children() const noexcept;

    /// Requires: 0 <= ancestorLevel <= level.
    [[nodiscard]] TileId ancestor(int ancestorLevel) const noexcept;

    /// The tile across the edge, round the globe. Returns: nullopt at a pole.
    [[nodiscard]] std::optional<TileId> neighbour(Edge edge) const noexcept;

    [[nodiscard]] RectDeg rect() const noexcept;

    [[nodiscard]] bool operator==(const TileId& other) const noexcept {
        return level == other.level && x == other.x && y == other.y;
    }
    [[nodiscard]] bool operator<(const TileId& other) const noexcept;
};

/// A post of the grid of one level, counted from the south-west corner of the globe.
struct PostId {
    int level = 0;
    std::int64_t column = 0;
    std::int64_t row = 0;
};

/// The grid of posts that all tiles share.
class TileLayout final {
public:
    static constexpr int kDeepest = 20;
    static constexpr double kStartTileDeg = 22.5;

    /// Whether a raster has more to show than posts with this spacing; one that is only just too wide is not worth
    /// another level.
    [[nodiscard]] static bool isFiner(double resolutionDeg, double spacingDeg) noexcept;

    /// Chooses the cells per tile edge, an even number in 24 .. 46, so that at some level the distance between posts
    /// is just at or below the resolution.
    [[nodiscard]] static int cellsFor(double resolutionDeg) noexcept;

    /// The first level than whose posts the raster is not finer; at most kDeepest.
    [[nodiscard]] static int levelFor(double resolutionDeg, int cells) noexcept;

    /// `region`: all that is refined, the whole globe without.
    TileLayout(int cells, int deepestLevel, const core::Ellipsoid& ellipsoid,
               const std::optional<RectDeg>& region = std::nullopt);

    /// The level of the coarsest tiles: 0 for a globe; for a region the deepest of which few tiles cover it.
    [[nodiscard]] int startLevel() const noexcept { return _startLevel; }

    /// The coarsest tiles, row by row from the south-west. Those of a region fill a rectangle.
    [[nodiscard]] const std::vector<TileId>& startTiles() const noexcept { return _startTiles; }

    /// Whether the region has more than an edge in common with the tile.
    [[nodiscard]] bool isInRegion(const TileId& tile) const noexcept;

    [[nodiscard]] bool isRegional() const noexcept { return _region.has_value(); }

    /// Even, so that every other post of a tile is a post of its parent.
    [[nodiscard]] int cells() const noexcept { return _cells; }
    [[nodiscard]] int posts() const noexcept { return _cells + 1; }
    [[nodiscard]] int deepestLevel() const noexcept { return _deepestLevel; }
    [[nodiscard]] const core::Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }
    [[nodiscard]] double spacingDeg(int level) const noexcept;

    /// The post's position, with the same bits at every level that has the post. Columns count round the globe;
    /// rows beyond a pole stop there; all posts at a pole are one, at longitude -180.
    [[nodiscard]] PositionDeg position(PostId post) const noexcept;

    /// The same position without going round the globe: -180 and 180 are two longitudes.
    [[nodiscard]] core::Geodetic geodetic(PostId post, double altitude) const noexcept;

    /// The south-west post of a tile, in the grid of a level at or below the tile's.
    [[nodiscard]] PostId firstPost(const TileId& tile, int level) const noexcept;

    /// The grid, in metres, to which vertices of a level are rounded in ECEF. Offsets of a tile's vertices from its
    /// origin are whole multiples of it that fit the 24 bits of a float: so they are stored without rounding, and
    /// tiles that share a post of a level draw it at the very same point.
    [[nodiscard]] double quantum(int level) const noexcept;

private:
    int _cells;
    int _deepestLevel;
    std::optional<RectDeg> _region;
    int _startLevel = 0;
    std::vector<TileId> _startTiles;
    core::Ellipsoid _ellipsoid;
};

}  // namespace osgAnalyticBin::tiles

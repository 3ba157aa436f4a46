// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileLayout.h"

#include <glm/trigonometric.hpp>

#include <tuple>

namespace osgAnalyticBin::tiles {

namespace {

std::int64_t wrapped(std::int64_t value, std::int64_t count) {
    return ((value % count) + count) % count;
}

/// The tiles of a level that have more than an edge in common with the region, row by row from the south-west.
std::vector<TileId> tilesOf(int level, const std::optional<RectDeg>& region) {
    const RectDeg rect = region.value_or(RectDeg{-180.0, -90.0, 180.0, 90.0});
    const TileId all{level, 0, 0};
    const double size = std::ldexp(TileLayout::kStartTileDeg, -level);
    const auto firstOf = [size](double place) { return static_cast<std::int64_t>(std::floor(place / size)); };
    const auto endOf = [size](double place) { return static_cast<std::int64_t>(std::ceil(place / size)); };
    const std::int64_t west = firstOf(rect.west + 180.0);
    const std::int64_t east = std::min(endOf(rect.east + 180.0), west + all.columns());
    const std::int64_t south = std::max<std::int64_t>(firstOf(rect.south + 90.0), 0);
    const std::int64_t north = std::min<std::int64_t>(endOf(rect.north + 90.0), all.rows());
    std::vector<TileId> tiles;
    for (std::int64_t y = south; y < north; ++y)
        for (std::int64_t x = west; x < east; ++x)
            tiles.push_back({level, static_cast<int>(wrapped(x, all.columns())), static_cast<int>(y)});
    return tiles;
}

}  // namespace

std::array<TileId, 4> TileId::children() const noexcept {
    return {TileId{level + 1, 2 * x, 2 * y}, TileId{level + 1, 2 * x + 1, 2 * y}, TileId{level + 1, 2 * x, 2 * y + 1},
            TileId{level + 1, 2 * x + 1, 2 * y + 1}};
}

TileId TileId::ancestor(int ancestorLevel) const noexcept {
    const int shift = level - ancestorLevel;
    return {ancestorLevel, x >> shift, y >> shift};
}

std::optional<TileId> TileId::neighbour(Edge edge) const noexcept {
    const int east = edge == Edge::East ? x + 1 : edge == Edge::West ? x + columns() - 1 : x;
    const int north = edge == Edge::North ? y + 1 : edge == Edge::South ? y - 1 : y;
    if (north < 0 || north >= rows()) return std::nullopt;
    return TileId{level, east % columns(), north};
}

RectDeg TileId::rect() const noexcept {
    // Powers of two: exact.
    const double size = std::ldexp(TileLayout::kStartTileDeg, -level);
    return {-180.0 + x * size, -90.0 + y * size, -180.0 + (x + 1) * size, -90.0 + (y + 1) * size};
}

bool TileId::operator<(const TileId& other) const noexcept {
    return std::tie(level, y, x) < std::tie(other.level, other.y, other.x);
}

bool TileLayout::isFiner(double resolutionDeg, double spacingDeg) noexcept {
    constexpr double kTolerance = 1.05;
    return resolutionDeg * kTolerance < spacingDeg;
}

int TileLayout::cellsFor(double resolutionDeg) noexcept {
    constexpr double kMost = 46.0;
    constexpr int kFewest = 24;
    // A start tile of a raster with a whole number of posts has that number, though the resolution is rounded.
    double cells = kStartTileDeg / resolutionDeg * (1.0 - 1e-7);
    for (int level = 0; cells > kMost && level < kDeepest; ++level) cells *= 0.5;
    const int even = 2 * static_cast<int>(std::ceil(0.5 * std::min(cells, kMost)));
    return std::max(even, kFewest);
}

int TileLayout::levelFor(double resolutionDeg, int cells) noexcept {
    int level = 0;
    while (level < kDeepest && isFiner(resolutionDeg, std::ldexp(kStartTileDeg / cells, -level))) ++level;
    return level;
}

TileLayout::TileLayout(int cells, int deepestLevel, const core::Ellipsoid& ellipsoid,
                       const std::optional<RectDeg>& region)
    : _cells(cells), _deepestLevel(deepestLevel), _region(region), _ellipsoid(ellipsoid) {
    constexpr std::size_t kMostStartTiles = 16;
    _startTiles = tilesOf(0, region);
    while (_region && _startLevel < _deepestLevel) {
        std::vector<TileId> finer = tilesOf(_startLevel + 1, region);
        if (finer.size() > kMostStartTiles) break;
        _startTiles = std::move(finer);
        ++_startLevel;
    }
}

bool TileLayout::isInRegion(const TileId& tile) const noexcept {
    return !_region || tile.rect().overlap(*_region) > 0.0;
}

double TileLayout::spacingDeg(int level) const noexcept {
    return std::ldexp(kStartTileDeg / _cells, -level);
}

PositionDeg TileLayout::position(PostId post) const noexcept {
    const std::int64_t columns = static_cast<std::int64_t>(TileId::kStartColumns * _cells) << post.level;
    const std::int64_t rows = columns / 2;
    const std::int64_t row = std::clamp<std::int64_t>(post.row, 0, rows);
    const bool isPole = row == 0 || row == rows;
    const std::int64_t column = isPole ? 0 : wrapped(post.column, columns);
    // Numerator and denominator double from level to level, both exactly, so the quotient stays the same.
    return {-90.0 + 180.0 * static_cast<double>(row) / static_cast<double>(rows),
            -180.0 + 360.0 * static_cast<double>(column) / static_cast<double>(columns)};
}

core::Geodetic TileLayout::geodetic(PostId post, double altitude) const noexcept {
    const double columns = std::ldexp(TileId::kStartColumns * _cells, post.level);
    const double longitudeDeg = -180.0 + 360.0 * static_cast<double>(post.column) / columns;
    return {glm::radians(position(post).latitudeDeg), glm::radians(longitudeDeg), altitude};
}

PostId TileLayout::firstPost(const TileId& tile, int level) const noexcept {
    const int shift = level - tile.level;
    return {level, (static_cast<std::int64_t>(tile.x) * _cells) << shift,
            (static_cast<std::int64_t>(tile.y) * _cells) << shift};
}

double TileLayout::quantum(int level) const noexcept {
    // A start tile's corner is at most 0.28 radii from its middle. From one millimetre on finer steps would gain
    // nothing, and heights need room too.
    constexpr double kReach = 0.3;
    constexpr double kFinest = 1.0 / 1024.0;
    const double a = _ellipsoid.equatorialRadius();
    const double b = _ellipsoid.polarRadius();
    const double reach = kReach * std::max(a * a / b, b * b / a);
    const int exponent = static_cast<int>(std::ceil(std::log2(reach))) - 24 - level;
    return std::max(std::ldexp(1.0, exponent), kFinest);
}

}  // namespace osgAnalyticBin::tiles

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HeightGrid.h"

#include "TerrainGrid.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace osgbindem {

namespace {

std::string placeOf(const Tally::Extreme& extreme) {
    std::ostringstream out;
    const double longitude = std::remainder(extreme.position.longitudeDeg, 360.0);
    out << std::fixed << std::setprecision(1) << extreme.metres << " m (" << std::setprecision(4)
        << std::abs(extreme.position.latitudeDeg) << (extreme.position.latitudeDeg < 0.0 ? " S, " : " N, ")
        << std::abs(longitude) << (longitude < 0.0 ? " W)" : " E)");
    return out.str();
}

}  // namespace

void Tally::add(const Tally& other) noexcept {
    tiles += other.tiles;
    deepest = std::max(deepest, other.deepest);
    files += other.files;
    bytes += other.bytes;
    posts += other.posts;
    filled += other.filled;
    missing += other.missing;
    if (other.lowest.metres < lowest.metres) lowest = other.lowest;
    if (other.highest.metres > highest.metres) highest = other.highest;
}

std::string Tally::text(const std::string& name, int startLevel, double seconds) const {
    std::ostringstream out;
    out << std::fixed << std::setprecision(0) << name << ": " << tiles << " tiles in levels " << startLevel << " to "
        << deepest << ", " << files << " files, " << std::setprecision(1) << std::ldexp(bytes, -20) << " MiB, "
        << seconds << " s";
    if (missing < posts) out << "\nheights from " << placeOf(lowest) << " to " << placeOf(highest);
    out << std::setprecision(0) << "; of " << posts << " posts, " << filled << " are filled voids and " << missing
        << " are at 0 m without data";
    return out.str();
}

std::string Tally::warning() const {
    if (missing == 0.0) return {};
    std::ostringstream out;
    out << "osgbindem: warning: no raster has data for " << std::fixed << std::setprecision(0) << missing << " of "
        << posts << " posts, which are at 0 m; add a raster below, or build a part of the earth with -te";
    return out.str();
}

HeightGrid::HeightGrid(const TileId& tile, const TileLayout& layout)
    : _tile(tile),
      _cells(layout.cells()),
      _heights(static_cast<std::size_t>((layout.cells() + 3) * (layout.cells() + 3)), 0.0) {}

std::optional<DemMosaic::Found> HeightGrid::samplePost(DemMosaic& mosaic, const TileLayout& layout, int column,
                                                       int row) {
    PostId post = layout.firstPost(_tile, _tile.level);
    post.column += column;
    post.row += row;
    // What is stored is in whole steps; posts that tiles share are rounded alike.
    constexpr double kStep = osgAnalyticBin::TerrainGrid::kStep;
    const auto found = mosaic.find(layout.position(post));
    _heights[index(column, row)] = std::nearbyint((found ? found->metres : 0.0) / kStep) * kStep;
    return found;
}

Tally HeightGrid::sample(DemMosaic& mosaic, const TileLayout& layout) {
    Tally tally;
    const RectDeg rect = _tile.rect();
    const double spacing = layout.spacingDeg(_tile.level);
    for (int row = 0; row <= _cells; ++row) {
        for (int column = 0; column <= _cells; ++column) {
            const auto found = samplePost(mosaic, layout, column, row);
            if (row == _cells || column == _cells) continue;
            ++tally.posts;
            if (!found) ++tally.missing;
            if (found) tally.addHeight(at(column, row), {rect.south + row * spacing, rect.west + column * spacing});
            if (found && found->isFilled) ++tally.filled;
        }
    }
    return tally;
}

void HeightGrid::takeFrom(const HeightGrid& child) {
    const int half = _cells / 2;
    const int firstColumn = child._tile.x % 2 == 0 ? 0 : half;
    const int firstRow = child._tile.y % 2 == 0 ? 0 : half;
    for (int row = 0; row <= half; ++row) {
        for (int column = 0; column <= half; ++column) {
            _heights[index(firstColumn + column, firstRow + row)] = child.at(2 * column, 2 * row);
        }
    }
}

void HeightGrid::sampleRing(DemMosaic& mosaic, const TileLayout& layout) {
    for (int i = -1; i <= _cells + 1; ++i) {
        samplePost(mosaic, layout, i, -1);
        samplePost(mosaic, layout, i, _cells + 1);
        samplePost(mosaic, layout, -1, i);
        samplePost(mosaic, layout, _cells + 1, i);
    }
}

HeightRange HeightGrid::range() const noexcept {
    HeightRange range;
    for (int row = 0; row <= _cells; ++row) {
        for (int column = 0; column <= _cells; ++column) range.include(at(column, row));
    }
    return range;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../EarthScale.h"
#include "PlateCells.h"

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

// The cells between four posts each.
class PostCells {
public:
    PostCells(const GeodeticGrid& grid, const std::vector<double>& altitudes) : _grid(grid), _altitudes(altitudes) {}

    // Calls visit(row, column, altitudes of the four posts), rows from south to north.
    template <class Visit>
    void forEach(Visit&& visit) const {
        for (std::size_t row = 0; row + 1 < _grid.rows; ++row) {
            const double* const south = &_altitudes[row * _grid.columns];
            const double* const north = south + _grid.columns;
            for (std::size_t column = 0; column + 1 < _grid.columns; ++column) {
                const double west = std::min(south[column], north[column]);
                const double east = std::min(south[column + 1], north[column + 1]);
                const double highWest = std::max(south[column], north[column]);
                const double highEast = std::max(south[column + 1], north[column + 1]);
                visit(row, column, Interval{std::min(west, east), std::max(highWest, highEast)});
            }
        }
    }

    // Of all posts.
    [[nodiscard]] Interval altitude() const {
        const auto [least, greatest] = std::minmax_element(_altitudes.begin(), _altitudes.end());
        return {*least, *greatest};
    }
    // The largest within one cell.
    [[nodiscard]] double rise() const {
        double most = 0.0;
        forEach(
            [&most](std::size_t, std::size_t, const Interval& altitude) { most = std::max(most, altitude.width()); });
        return most;
    }

private:
    const GeodeticGrid& _grid;
    const std::vector<double>& _altitudes;
};

// The cells of a grid of plates that each row or column of cells between posts reaches into.
std::vector<CellRange> rangesOf(const Interval& extents, std::size_t cells, std::size_t posts, double reach) {
    std::vector<CellRange> ranges;
    const double width = extents.width() / static_cast<double>(posts - 1);
    for (std::size_t i = 0; i + 1 < posts; ++i) {
        const double from = extents.lower + width * static_cast<double>(i);
        ranges.push_back(cellsIn(extents, cells, {from - reach, from + width + reach}));
    }
    return ranges;
}

}  // namespace

// Source: doc/theory/occlusion.md, section 3, "Grids".
GroundPlates::GroundPlates(const Ellipsoid& ellipsoid, const GeodeticGrid& grid, const std::vector<double>& altitudes,
                           double margin, double skirt)
    : GroundPlates(ellipsoid, grid.latitude, grid.longitude) {
    const bool isFinite = std::all_of(altitudes.begin(), altitudes.end(), [](double h) { return std::isfinite(h); });
    if (!isFinite || grid.columns < 3 || grid.rows < 3 || !mayStandBeside(margin)) return;

    const PostCells cells(grid, altitudes);
    const Interval altitude = cells.altitude();
    const double radius = 0.9 * smallestCurvatureRadius(ellipsoid);
    const double along = grid.latitude.width() / static_cast<double>(grid.rows - 1);
    const double across = grid.longitude.width() / static_cast<double>(grid.columns - 1);
    const auto [south, north] = grid.latitude;
    const double equatorward = south * north < 0.0 ? 0.0 : std::min(std::abs(south), std::abs(north));
    const double poleward = std::max(std::abs(south), std::abs(north));
    const double farthest = largestCurvatureRadius(ellipsoid) + std::max(altitude.upper, 0.0);
    // along the surface from post to post
    const double walk = farthest * std::hypot(along, std::cos(equatorward) * across);
    const double rise = cells.rise(), longest = walk + rise;
    const TriangleSides sides = TriangleSides::atAnyPoint(longest, walk, rise, radius);
    const double axisDistance = 0.95 * radius * std::cos(poleward);
    const TriangleReach reach(sides, ellipsoid, radius, axisDistance);
    if (!TriangleReach::holdsFor(sides, radius, axisDistance, across, {altitude.lower - reach.sag, altitude.upper}))
        return;
    // columns keep out of the rims, which the outermost chords may cut
    const bool isWithinRims =
        reach.aside < kBorder * grid.latitude.width() && reach.around < kBorder * grid.longitude.width();
    if (!isWithinRims) return;

    std::array<double, kNumbers> low;
    low.fill(std::numeric_limits<double>::infinity());
    for (const std::size_t side : kCellsOfGrids) {
        const std::vector<CellRange> rows = rangesOf(grid.latitude, side, grid.rows, reach.aside);
        const std::vector<CellRange> columns = rangesOf(grid.longitude, side, grid.columns, reach.around);
        cells.forEach([&](std::size_t row, std::size_t column, const Interval& between) {
            for (std::ptrdiff_t i = rows[row].first; i <= rows[row].last; ++i) {
                for (std::ptrdiff_t j = columns[column].first; j <= columns[column].last; ++j) {
                    double& bound = low[numberOf(side, static_cast<std::size_t>(i), static_cast<std::size_t>(j))];
                    bound = std::min(bound, between.lower - reach.sag);
                }
            }
        });
    }
    std::array<double, kParts> high;
    high.fill(-std::numeric_limits<double>::infinity());
    cells.forEach([&](std::size_t row, std::size_t column, const Interval& between) {
        const auto met = [](const Interval& extents, double width, std::size_t i, double beyond) -> Interval {
            const double from = extents.lower + width * static_cast<double>(i);
            return {from - beyond, from + width + beyond};
        };
        forEachPart(grid.latitude, grid.longitude, met(grid.latitude, along, row, reach.aside),
                    met(grid.longitude, across, column, reach.around),
                    [&](std::size_t part) { high[part] = std::max(high[part], between.upper); });
    });
    encode(low, high, margin);
    if (!mayHang(skirt)) _most.fill(0);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../EarthScale.h"
#include "PlateCells.h"

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

// What is between the four posts of each cell, row by row from the south-west.
std::vector<Interval> cellsOf(const GeodeticGrid& grid, const std::vector<double>& altitudes) {
    std::vector<Interval> cells;
    cells.reserve((grid.rows - 1) * (grid.columns - 1));
    for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
        const double* const south = &altitudes[row * grid.columns];
        const double* const north = south + grid.columns;
        for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
            const double low = std::min(south[column], north[column]), high = std::max(south[column], north[column]);
            const double lowEast = std::min(south[column + 1], north[column + 1]);
            const double highEast = std::max(south[column + 1], north[column + 1]);
            cells.push_back({std::min(low, lowEast), std::max(high, highEast)});
        }
    }
    return cells;
}

// What each row or column of cells between posts reaches into.
std::vector<MetCells> metBy(const Interval& extents, std::size_t posts, double reach) {
    const CellsAlong along(extents);
    const double width = extents.width() / static_cast<double>(posts - 1);
    std::vector<MetCells> met;
    for (std::size_t i = 0; i + 1 < posts; ++i) {
        const double from = extents.lower + width * static_cast<double>(i);
        met.push_back(along.met({from - reach, from + width + reach}));
    }
    return met;
}

}  // namespace

// Source: doc/theory/occlusion.md, section 3, "Grids".
GroundPlates::GroundPlates(const Ellipsoid& ellipsoid, const GeodeticGrid& grid, const std::vector<double>& altitudes,
                           double margin, double skirt)
    : GroundPlates(ellipsoid, grid.latitude, grid.longitude) {
    const bool isFinite = std::all_of(altitudes.begin(), altitudes.end(), [](double h) { return std::isfinite(h); });
    if (!isFinite || grid.columns < 3 || grid.rows < 3 || !mayStandBeside(margin)) return;

    const std::vector<Interval> cells = cellsOf(grid, altitudes);
    Interval altitude = Interval::none();
    double rise = 0.0;
    for (const Interval& cell : cells) {
        altitude = altitude.united(cell);
        rise = std::max(rise, cell.width());
    }
    const double radius = 0.9 * smallestCurvatureRadius(ellipsoid);
    const double along = grid.latitude.width() / static_cast<double>(grid.rows - 1);
    const double across = grid.longitude.width() / static_cast<double>(grid.columns - 1);
    const auto [south, north] = grid.latitude;
    const double equatorward = south * north < 0.0 ? 0.0 : std::min(std::abs(south), std::abs(north));
    const double poleward = std::max(std::abs(south), std::abs(north));
    const double farthest = largestCurvatureRadius(ellipsoid) + std::max(altitude.upper, 0.0);
    // along the surface from post to post
    const double walk = farthest * std::hypot(along, std::cos(equatorward) * across);
    const double longest = walk + rise;
    const TriangleSides sides = TriangleSides::atAnyPoint(longest, walk, rise, radius);
    const double axisDistance = 0.95 * radius * std::cos(poleward);
    const TriangleReach reach(sides, ellipsoid, radius, axisDistance);
    if (!TriangleReach::holdsFor(sides, radius, axisDistance, {altitude.lower - reach.sag, altitude.upper})) return;
    // columns keep out of the rims, which the outermost chords may cut
    const bool isWithinRims =
        reach.aside < kBorder * grid.latitude.width() && reach.around < kBorder * grid.longitude.width();
    if (!isWithinRims) return;

    const std::vector<MetCells> rows = metBy(grid.latitude, grid.rows, reach.aside);
    const std::vector<MetCells> columns = metBy(grid.longitude, grid.columns, reach.around);
    PlateBounds found;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t row = i / (grid.columns - 1), column = i % (grid.columns - 1);
        found.lower(rows[row], columns[column], cells[i].lower - reach.sag);
        found.raise(rows[row], columns[column], cells[i].upper);
    }
    encode(found, margin);
    if (!mayHang(skirt)) _most.fill(0);
}

}  // namespace osgAnalyticBin::core

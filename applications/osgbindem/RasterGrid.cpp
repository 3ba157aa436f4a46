// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterGrid.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

int floorOf(double value) {
    return static_cast<int>(std::floor(value));
}
int ceilOf(double value) {
    return static_cast<int>(std::ceil(value));
}

}  // namespace

RasterGrid::RasterGrid(const std::array<double, 6>& geoTransform, int width, int height) noexcept
    : _width(width),
      _height(height),
      _dx(geoTransform[1]),
      _dy(geoTransform[5]),
      _firstLongitude(geoTransform[0] + 0.5 * geoTransform[1]),
      _firstLatitude(geoTransform[3] + 0.5 * geoTransform[5]) {
    // Printed pixel sizes are slightly off. A raster with as many columns as fit round the globe is global, and so is
    // one that repeats its first column at the end, which is then left out.
    const double fitting = std::nearbyint(360.0 / _dx);
    if (fitting == _width || fitting == _width - 1) {
        _isGlobal = true;
        _width = static_cast<int>(fitting);
        _dx = 360.0 / fitting;
    }
}

RectDeg RasterGrid::extent() const noexcept {
    const double west = _firstLongitude - 0.5 * _dx;
    const double a = _firstLatitude - 0.5 * _dy;
    const double b = a + _height * _dy;
    return {west, std::min(a, b), west + _width * _dx, std::max(a, b)};
}

bool RasterGrid::covers(const RectDeg& rect) const noexcept {
    return overlap(rect) >= (1.0 - kSnap) * (rect.east - rect.west) * (rect.north - rect.south);
}

std::optional<PostCell> RasterGrid::locate(const PositionDeg& position) const noexcept {
    const auto snapped = [](double value) {
        const double nearest = std::nearbyint(value);
        return std::abs(value - nearest) < kSnap ? nearest : value;
    };
    const double half = 0.5 + kSnap;
    double row = rowOf(position.latitudeDeg);
    if (!(row >= -half && row <= _height - 1 + half)) return std::nullopt;
    row = std::clamp(snapped(row), 0.0, _height - 1.0);

    const double turn = _isGlobal ? _width : 360.0 / _dx;
    double column = columnOf(position.longitudeDeg) + half;
    column = snapped(column - std::floor(column / turn) * turn - half);
    if (_isGlobal) {
        if (column < 0.0) column += turn;
    } else {
        if (column > _width - 1 + half) return std::nullopt;
        column = std::clamp(column, 0.0, _width - 1.0);
    }

    PostCell cell;
    cell.west = floorOf(column);
    cell.eastWeight = column - cell.west;
    cell.west %= _width;
    cell.east = cell.eastWeight > 0.0 ? (cell.west + 1) % _width : cell.west;
    cell.first = floorOf(row);
    cell.secondWeight = row - cell.first;
    cell.second = cell.secondWeight > 0.0 ? cell.first + 1 : cell.first;
    return cell;
}

std::vector<PixelWindow> RasterGrid::windows(const RectDeg& rect, double snap, int inward) const {
    const auto [low, high] = std::minmax({rowOf(rect.south), rowOf(rect.north)});
    const int firstColumn = floorOf(columnOf(rect.west) + snap) + inward;
    const int lastColumn = ceilOf(columnOf(rect.east) - snap) - inward;
    const int lastRow = ceilOf(high - snap) - inward;
    const int first = std::max(floorOf(low + snap) + inward, 0);
    const int rows = std::min(lastRow, _height - 1) - first + 1;
    if (rows <= 0 || lastColumn < firstColumn) return {};
    if (_isGlobal && lastColumn - firstColumn >= _width) return {{0, first, _width, rows}};
    std::vector<PixelWindow> result;
    const double turn = _isGlobal ? _width : 360.0 / _dx;
    for (int k = -2; k <= 2; ++k) {
        const int a = std::max(0, floorOf(firstColumn + k * turn));
        const int b = std::min(_width - 1, ceilOf(lastColumn + k * turn));
        if (a <= b) result.push_back({a, first, b - a + 1, rows});
    }
    return result;
}

}  // namespace osgbindem

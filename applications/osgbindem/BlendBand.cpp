// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BlendBand.h"

#include "Angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <utility>

namespace osgbindem {

namespace {

using osgAnalyticBin::support::kRadiansPerDegree;

// Rasters of one resolution have pixel sizes that differ in their last digits.
constexpr double kEquallyFine = 1.01;

double cosine(double latitudeDeg) {
    return std::cos(latitudeDeg * kRadiansPerDegree);
}

/// The distance between two intervals, 0 when they meet.
double gap(double aLow, double aHigh, double bLow, double bHigh) {
    return std::max({0.0, bLow - aHigh, aLow - bHigh});
}

/// The rectangle and its copies a turn to either side.
std::array<RectDeg, 3> turnsOf(const RectDeg& rect) {
    return {rect,
            {rect.west - 360.0, rect.south, rect.east - 360.0, rect.north},
            {rect.west + 360.0, rect.south, rect.east + 360.0, rect.north}};
}

/// The area of a raster, and its copies a turn to either side; one round the globe has no end in the west and east.
std::array<RectDeg, 3> areasOf(const RasterGrid& grid) {
    RectDeg rect = grid.extent();
    if (grid.isGlobal()) {
        rect.west -= 720.0;
        rect.east += 720.0;
    }
    return turnsOf(rect);
}

/// Metres; 0 when no coarser raster lies below.
double defaultWidth(const RasterGrid& grid, const std::vector<RasterGrid>& all, double metresPerDegree) {
    constexpr double kLargestPart = 1.0 / 8.0;
    const RectDeg extent = grid.extent();
    double spacing = std::numeric_limits<double>::infinity();
    for (const RasterGrid& other : all) {
        if (other.resolutionDeg() > kEquallyFine * grid.resolutionDeg() && other.overlap(extent) > 0.0)
            spacing = std::min(spacing, other.resolutionDeg());
    }
    if (!std::isfinite(spacing)) return 0.0;
    const double middle = 0.5 * (extent.south + extent.north);
    const double side = std::min(extent.north - extent.south, (extent.east - extent.west) * cosine(middle));
    return metresPerDegree * std::min(spacing, kLargestPart * side);
}

}  // namespace

BlendBand::BlendBand(const RasterGrid& grid, const std::vector<RasterGrid>& all, const std::optional<double>& width,
                     double radius)
    : _metresPerDegree(radius * kRadiansPerDegree) {
    _width = width ? *width : defaultWidth(grid, all, _metresPerDegree);
    if (!(_width > 0.0)) return;
    const RectDeg own = grid.extent();
    _west = own.west;
    const double pixel = grid.resolutionDeg();
    // Others that go on beyond the border, as parts of the south, north, west and east edge.
    std::array<std::vector<RectDeg>, 4> closed;
    for (const RasterGrid& other : all) {
        const bool isCoarser = other.resolutionDeg() > kEquallyFine * pixel;
        const double overlap = 2.0 * std::max(pixel, other.resolutionDeg());
        for (const RectDeg& rect : areasOf(other)) {
            const auto goesOn = [&](double beyond, double near) {
                return beyond > 0.5 * pixel && near > -pixel && (!isCoarser || near < overlap);
            };
            if (goesOn(own.south - rect.south, rect.north - own.south)) closed[0].push_back(rect);
            if (goesOn(rect.north - own.north, own.north - rect.south)) closed[1].push_back(rect);
            if (goesOn(own.west - rect.west, rect.east - own.west)) closed[2].push_back(rect);
            if (goesOn(rect.east - own.east, own.east - rect.west)) closed[3].push_back(rect);
        }
    }
    if (own.south > -90.0 + pixel) addEdge({own.west, own.south, own.east, own.south}, closed[0]);
    if (own.north < 90.0 - pixel) addEdge({own.west, own.north, own.east, own.north}, closed[1]);
    if (grid.isGlobal()) return;
    addEdge({own.west, own.south, own.west, own.north}, closed[2]);
    addEdge({own.east, own.south, own.east, own.north}, closed[3]);
}

void BlendBand::addEdge(const RectDeg& edge, const std::vector<RectDeg>& closed) {
    const bool isParallel = edge.south == edge.north;
    std::vector<std::pair<double, double>> open{isParallel ? std::pair(edge.west, edge.east)
                                                           : std::pair(edge.south, edge.north)};
    for (const RectDeg& rect : closed) {
        const double low = isParallel ? rect.west : rect.south;
        const double high = isParallel ? rect.east : rect.north;
        std::vector<std::pair<double, double>> left;
        for (const auto& [from, to] : open) {
            if (low > from) left.emplace_back(from, std::min(low, to));
            if (high < to) left.emplace_back(std::max(high, from), to);
        }
        open = std::move(left);
    }
    // What is left of an edge by rounding is no border.
    constexpr double kLeast = 1e-4;
    for (const auto& [from, to] : open) {
        if (to - from < kLeast) continue;
        _edges.push_back(isParallel ? RectDeg{from, edge.south, to, edge.north}
                                    : RectDeg{edge.west, from, edge.east, to});
    }
}

double BlendBand::shareWithin(const PositionDeg& position) const noexcept {
    const double latitude = position.latitudeDeg;
    // Half a pixel of rounding at the western border is not a turn.
    constexpr double kSlack = 1e-6;
    const double turns = std::floor((position.longitudeDeg - _west + kSlack) / 360.0);
    const double longitude = position.longitudeDeg - 360.0 * turns;
    const double east = cosine(latitude);
    double nearest = std::numeric_limits<double>::infinity();
    for (const RectDeg& edge : _edges) {
        const double y = gap(latitude, latitude, edge.south, edge.north);
        const double x = east * gap(longitude, longitude, edge.west, edge.east);
        nearest = std::min(nearest, x * x + y * y);
    }
    const double share = std::min(_metresPerDegree * std::sqrt(nearest) / _width, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

bool BlendBand::touches(const RectDeg& rect) const noexcept {
    const double east = std::min(cosine(rect.south), cosine(rect.north));
    for (const RectDeg& edge : _edges) {
        for (const RectDeg& turned : turnsOf(edge)) {
            const double y = gap(rect.south, rect.north, turned.south, turned.north);
            const double x = east * gap(rect.west, rect.east, turned.west, turned.east);
            if (_metresPerDegree * std::hypot(x, y) <= _width) return true;
        }
    }
    return false;
}

void BlendBand::describe(std::ostream& out) const {
    out << _width;
    for (const RectDeg& edge : _edges) {
        out << ", " << edge.west << ' ' << edge.south << ' ' << edge.east << ' ' << edge.north;
    }
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Coverage.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

constexpr double kPi = 3.14159265358979323846;

// The length that intervals cover together.
double lengthOf(std::vector<core::Interval>& intervals) {
    std::sort(intervals.begin(), intervals.end(),
              [](const core::Interval& a, const core::Interval& b) { return a.lower < b.lower; });
    double length = 0.0;
    double end = -1e9;
    for (const core::Interval& interval : intervals) {
        length += std::max(0.0, interval.upper - std::max(interval.lower, end));
        end = std::max(end, interval.upper);
    }
    return length;
}

}  // namespace

double Coverage::areaOf(const core::GeodeticBin& extents) {
    return extents.empty() ? 0.0 : extents.latitude().width() * extents.longitude().width();
}

void Coverage::expectGlobe() {
    _expected = 2.0 * kPi * kPi;
}

void Coverage::add(const core::GeodeticBin& tile) {
    if (tile.empty()) return;
    _smallest = std::min(_smallest, areaOf(tile));
    const double width = std::min(tile.longitude().width(), 2.0 * kPi);
    const double west = std::remainder(tile.longitude().lower, 2.0 * kPi);
    const double east = west + width;
    _tiles.emplace_back(tile.latitude(), core::Interval{west, std::min(east, kPi)}, tile.altitude());
    if (east > kPi) _tiles.emplace_back(tile.latitude(), core::Interval{-kPi, east - 2.0 * kPi}, tile.altitude());
}

// Strip by strip from the south, between the latitudes at which tiles begin or end.
double Coverage::area() const {
    std::vector<double> latitudes;
    for (const core::GeodeticBin& tile : _tiles) {
        latitudes.insert(latitudes.end(), {tile.latitude().lower, tile.latitude().upper});
    }
    std::sort(latitudes.begin(), latitudes.end());
    double area = 0.0;
    std::vector<core::Interval> longitudes;
    for (std::size_t i = 0; i + 1 < latitudes.size(); ++i) {
        const double south = latitudes[i];
        const double north = latitudes[i + 1];
        if (!(south < north)) continue;
        longitudes.clear();
        for (const core::GeodeticBin& tile : _tiles) {
            const bool isInStrip = tile.latitude().lower <= south && tile.latitude().upper >= north;
            if (isInStrip) longitudes.push_back(tile.longitude());
        }
        area += (north - south) * lengthOf(longitudes);
    }
    return area;
}

bool Coverage::hasGap() const {
    if (!_isVisited || !(_expected > 0.0)) return false;
    return _expected - area() >= 0.5 * std::min(_smallest, _expected);
}

}  // namespace osgAnalyticBin

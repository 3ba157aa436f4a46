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
    _isOfGlobe = true;
    setVisited();
}

void Coverage::add(const core::GeodeticBin& tile) {
    if (tile.empty()) return;
    _smallest = std::min(_smallest, areaOf(tile));
    _tallest = std::max(_tallest, tile.latitude().width());
    _widest = std::max(_widest, tile.longitude().width());
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

// From the first to the last tile eastward, beginning after the widest strip of longitudes without tiles.
core::GeodeticBin Coverage::extents() const {
    std::vector<core::Interval> longitudes;
    core::Interval latitude{kPi, -kPi};
    for (const core::GeodeticBin& tile : _tiles) {
        longitudes.push_back(tile.longitude());
        latitude = {std::min(latitude.lower, tile.latitude().lower), std::max(latitude.upper, tile.latitude().upper)};
    }
    if (longitudes.empty()) return {};
    std::sort(longitudes.begin(), longitudes.end(),
              [](const core::Interval& a, const core::Interval& b) { return a.lower < b.lower; });
    const double west = longitudes.front().lower;
    double east = west;
    core::Interval widest{0.0, 0.0};
    for (const core::Interval& longitude : longitudes) {
        if (longitude.lower - east > widest.width()) widest = {east, longitude.lower};
        east = std::max(east, longitude.upper);
    }
    // turns would round the small angles of a map
    if (west + 2.0 * kPi - east >= widest.width()) return {latitude, {west, east}, {0.0, 0.0}};
    return {latitude, {widest.upper, widest.lower + 2.0 * kPi}, {0.0, 0.0}};
}

bool Coverage::reachesPoles() const {
    constexpr double kNearPole = 1e-5;  // radians
    const core::Interval latitude = extents().latitude();
    return latitude.lower <= kNearPole - 0.5 * kPi && latitude.upper >= 0.5 * kPi - kNearPole;
}

core::GeodeticBin Coverage::region() const {
    constexpr double kBorder = 1.0 / 32.0;
    constexpr double kSeam = 2e-6;  // of a tile: vertices of neighbours are rounded apart
    constexpr double kRounding = 1e-9;
    Coverage filled;
    for (const FindFilled& findFilled : _meshes) {
        const core::GeodeticBin mesh = findFilled();
        if (mesh.empty()) return {};
        const auto [south, north] = mesh.latitude();
        const auto [west, east] = mesh.longitude();
        const double up = kSeam * (north - south), aside = kSeam * (east - west);
        filled.add({{south - up, north + up}, {west - aside, east + aside}, mesh.altitude()});
    }
    const core::GeodeticBin all = filled.extents();
    if (all.empty()) return {};
    // the edge of a mesh along a parallel is made of chords
    const double sag = filled._widest < 0.9 * kPi ? 0.55 * (1.0 / std::cos(0.5 * filled._widest) - 1.0) : kPi;
    const double margin = std::max(kBorder * filled._tallest, sag);
    const auto [west, east] = all.longitude();
    const bool isFullCircle = all.isFullCircle();
    const double aside = isFullCircle ? 0.0 : kBorder * filled._widest;
    const auto inside = [&](double latitude, double inward) {
        return isFullCircle && std::abs(latitude) >= 0.5 * kPi ? latitude : latitude + inward;
    };
    const core::GeodeticBin region({inside(all.latitude().lower, margin), inside(all.latitude().upper, -margin)},
                                   {west + aside, east - aside}, {0.0, 0.0});
    return areaOf(region) - filled.areaWithin(region) <= kRounding * areaOf(region) ? region : core::GeodeticBin();
}

double Coverage::areaWithin(const core::GeodeticBin& region) const {
    Coverage within;
    const auto common = [](const core::Interval& a, const core::Interval& b) {
        return core::Interval{std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
    };
    for (const core::GeodeticBin& tile : _tiles) {
        for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
            const core::Interval turned{tile.longitude().lower + turn, tile.longitude().upper + turn};
            within.add({common(tile.latitude(), region.latitude()), common(turned, region.longitude()), {0.0, 0.0}});
        }
    }
    return within.area();
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Coverage.h"

#include "../database/Database.h"
#include "../surface/TilePlates.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr core::Interval kNoHeight{0.0, 0.0};

using Places = std::vector<core::GeodeticBin>;

// The length of a range of longitudes that places, from west to east, leave open. They are within it.
double openLength(const core::Interval& whole, const std::vector<const core::GeodeticBin*>& places) {
    double length = 0.0;
    double end = whole.lower;
    for (const core::GeodeticBin* const place : places) {
        length += std::max(0.0, place->longitude().lower - end);
        end = std::max(end, place->longitude().upper);
    }
    return length + std::max(0.0, whole.upper - end);
}

// Square radians on the map of latitudes and longitudes, not on the globe.
double areaOf(const core::GeodeticBin& place) {
    return place.latitude().width() * place.longitude().width();
}

// What places within a whole one leave open, strip by strip from the south, between the latitudes at which one begins
// or ends. It is added up by itself: a small hole is lost in the rounding of large areas. Sorts the places.
double openArea(const core::GeodeticBin& whole, Places& places) {
    std::vector<double> latitudes{whole.latitude().lower, whole.latitude().upper};
    for (const core::GeodeticBin& place : places)
        latitudes.insert(latitudes.end(), {place.latitude().lower, place.latitude().upper});
    std::sort(latitudes.begin(), latitudes.end());
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.latitude().lower < b.latitude().lower; });
    double area = 0.0;
    // a flat database may have a hundred thousand tiles
    std::vector<const core::GeodeticBin*> across;  // the strip, from west to east
    auto next = places.begin();
    for (std::size_t i = 0; i + 1 < latitudes.size(); ++i) {
        const double south = latitudes[i], north = latitudes[i + 1];
        if (!(south < north)) continue;
        across.erase(std::remove_if(across.begin(), across.end(),
                                    [south](const auto* place) { return place->latitude().upper <= south; }),
                     across.end());
        for (; next != places.end() && next->latitude().lower <= south; ++next) {
            const auto isWest = [](double west, const auto* place) { return west < place->longitude().lower; };
            across.insert(std::upper_bound(across.begin(), across.end(), next->longitude().lower, isWest), &*next);
        }
        area += (north - south) * openLength(whole.longitude(), across);
    }
    return area;
}

// Adds a place that may run across the date line.
void addTo(Places& places, const core::Interval& latitude, const core::Interval& longitude) {
    if (!(latitude.width() > 0.0) || !(longitude.width() > 0.0)) return;
    const double width = std::min(longitude.width(), 2.0 * kPi);
    const double west = std::remainder(longitude.lower, 2.0 * kPi), east = west + width;
    places.emplace_back(latitude, core::Interval{west, std::min(east, kPi)}, core::Interval{0.0, 0.0});
    if (east > kPi) places.emplace_back(latitude, core::Interval{-kPi, east - 2.0 * kPi}, core::Interval{0.0, 0.0});
}

}  // namespace

void Coverage::expect(InstalledTile& tile) {
    _tile = &tile;
    _expected = tile.place();
}

void Coverage::report(const std::string& file, Database& database) const {
    const bool isWithGap = hasGap();
    if (_isOfGlobe) {
        const core::GeodeticBin covered = isWithGap ? region() : core::GeodeticBin();
        if (isWithGap && covered.empty()) database.report(Finding::Gap, file);
        return database.setRegion(covered);
    }
    if (isWithGap && !areVouchedFor(database.options(), *database.ellipsoid())) _tile->doubt(InstalledTile::GapBelow);
}

void Coverage::expectGlobe() {
    _expected = {{-0.5 * kPi, 0.5 * kPi}, {-kPi, kPi}, {0.0, 0.0}};
    _isOfGlobe = true;
    setVisited();
}

void Coverage::add(const core::GeodeticBin& place, bool isExact) {
    if (place.empty()) return;
    _isExact = _isExact && isExact;
    _smallest = std::min(_smallest, areaOf(place));
    _tallest = std::max(_tallest, place.latitude().width());
    _widest = std::max(_widest, place.longitude().width());
    constexpr double kSeam = 2e-6;  // of a tile: vertices of neighbours are rounded apart
    const double up = kSeam * place.latitude().width(), aside = kSeam * place.longitude().width();
    addTo(_places, {place.latitude().lower - up, place.latitude().upper + up},
          {place.longitude().lower - aside, place.longitude().upper + aside});
}

bool Coverage::hasGap() const {
    if (!_isVisited || (!_isOfGlobe && !_tile)) return false;
    return _expected.empty() || !covers(_expected);
}

bool Coverage::covers(const core::GeodeticBin& place) const {
    // a tile that is missing may be as small as the smallest one that is there
    constexpr double kRounding = 1e-9, kOfSmallest = 1e-3;
    Places within;
    const auto common = [](const core::Interval& a, const core::Interval& b) {
        return core::Interval{std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
    };
    for (const core::GeodeticBin& tile : _places) {
        for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
            const core::Interval turned{tile.longitude().lower + turn, tile.longitude().upper + turn};
            const core::Interval latitude = common(tile.latitude(), place.latitude());
            const core::Interval longitude = common(turned, place.longitude());
            if (latitude.width() > 0.0 && longitude.width() > 0.0) within.emplace_back(latitude, longitude, kNoHeight);
        }
    }
    return openArea(place, within) <= std::min(kRounding * areaOf(place), kOfSmallest * _smallest);
}

// From the first to the last tile eastward, beginning after the widest strip of longitudes without tiles.
core::GeodeticBin Coverage::extents() const {
    std::vector<core::Interval> longitudes;
    core::Interval latitude{kPi, -kPi};
    for (const core::GeodeticBin& tile : _places) {
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

core::GeodeticBin Coverage::region() const {
    constexpr double kBorder = 1.0 / 32.0;
    const core::GeodeticBin all = extents();
    if (all.empty() || !_isExact) return {};
    // the edge of a mesh along a parallel is made of chords
    const double sag = _widest < 0.9 * kPi ? 0.55 * (1.0 / std::cos(0.5 * _widest) - 1.0) : kPi;
    const double margin = std::max(kBorder * _tallest, sag);
    const auto [west, east] = all.longitude();
    const bool isFullCircle = all.isFullCircle();
    const double aside = isFullCircle ? 0.0 : kBorder * _widest;
    const auto inside = [&](double latitude, double inward) {
        return isFullCircle && std::abs(latitude) >= 0.5 * kPi ? latitude : latitude + inward;
    };
    const core::GeodeticBin region({inside(all.latitude().lower, margin), inside(all.latitude().upper, -margin)},
                                   {west + aside, east - aside}, {0.0, 0.0});
    return !region.empty() && covers(region) ? region : core::GeodeticBin();
}

}  // namespace osgAnalyticBin

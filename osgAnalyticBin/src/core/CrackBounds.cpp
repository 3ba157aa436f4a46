// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/CrackBounds.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Posts stand on the terrain, a little farther from the centre than the ellipsoid.
constexpr double kRoomForAltitude = 1.01;

constexpr double kPi = 3.14159265358979323846;

// Lines of one quadtree are a tile's half width apart, or the same up to the poleward run of meshes.
constexpr double kSameLine = 0.1;

double inheritedWidth(double width, double parentWidth, double distance) noexcept {
    return std::abs(distance) < kSameLine * width ? std::max(width, parentWidth) : width;
}

// The poleward run of a chord between two posts `angle` apart on a parallel: source doc/databases.md, (4.3).
double polewardRun(double angle, double latitude) noexcept {
    const double half = std::min(0.5 * angle, 1.0);
    return 0.55 * half * half * std::abs(std::sin(latitude) * std::cos(latitude));
}

}  // namespace

TileEdges TileEdges::of(const GeodeticBin& tile, const GeodeticBin* parentTile, const TileEdges* parentEdges) noexcept {
    const double lon = tile.longitude().width();
    const double lat = tile.latitude().width();
    TileEdges edges{lon, lat, lon, lat};
    if (!parentTile || !parentEdges) return edges;
    const GeodeticBin& p = *parentTile;
    edges.south = inheritedWidth(lon, parentEdges->south, (tile.latitude().lower - p.latitude().lower) * lon / lat);
    edges.north = inheritedWidth(lon, parentEdges->north, (tile.latitude().upper - p.latitude().upper) * lon / lat);
    const auto turn = [](double angle) { return std::remainder(angle, 2.0 * kPi); };
    edges.west = inheritedWidth(lat, parentEdges->west, turn(tile.longitude().lower - p.longitude().lower) * lat / lon);
    edges.east = inheritedWidth(lat, parentEdges->east, turn(tile.longitude().upper - p.longitude().upper) * lat / lon);
    return edges;
}

double sagOfArc(const Ellipsoid& ellipsoid, double angle) noexcept {
    // the flattest curve of the surface has the largest radius of curvature
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    const double largest = kRoomForAltitude * std::max({a * a / b, b * b / a, a});
    return angle < kPi ? largest * (1.0 - std::cos(0.5 * angle)) : 2.0 * std::max(a, b);
}

double crackDepth(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges) noexcept {
    const double southArc = edges.south * std::cos(tile.latitude().lower);
    const double northArc = edges.north * std::cos(tile.latitude().upper);
    return sagOfArc(ellipsoid, std::max({southArc, northArc, edges.west, edges.east}) / kFewestCells);
}

GeodeticBin withGaps(const GeodeticBin& tile, const TileEdges& edges) noexcept {
    Interval latitude = tile.latitude();
    if (latitude.upper > 0.0) latitude.upper += polewardRun(edges.north / kFewestCells, latitude.upper);
    if (latitude.lower < 0.0) latitude.lower -= polewardRun(edges.south / kFewestCells, latitude.lower);
    return GeodeticBin(latitude, tile.longitude(), tile.altitude());
}

double sagOfFinerMeshes(const Ellipsoid& ellipsoid, const GeodeticBin& tile, bool areGrids) noexcept {
    const Interval& latitude = tile.latitude();
    const double nearest = latitude.contains(0.0) ? 0.0 : std::min(std::abs(latitude.lower), std::abs(latitude.upper));
    const double diagonal = 0.5 * std::hypot(tile.longitude().width() * std::cos(nearest), latitude.width());
    return sagOfArc(ellipsoid, areGrids ? diagonal / kFewestCells : diagonal);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/mesh/CrackBounds.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

// Posts stand on the terrain, a little farther from the centre than the ellipsoid; of the largest radius of curvature.
constexpr double kRoomForAltitude = 1.01;

// Lines of one quadtree are a tile's half width apart, or the same up to the poleward run of meshes.
constexpr double kSameLine = 0.1;

// Between the square tiles of a quadtree and the whole globe, which VirtualPlanetBuilder parts into two.
constexpr double kWide = 1.5;

// Radians: rounding error of extents that were computed from meshes.
constexpr double kSameAngle = 1e-5;

struct Edge {
    double& width;
    bool& isOnBorder;
};

// `outward`: how far it lies beyond the parent's edge. Finer tiles may be wider than the mesh above them.
void inherit(const Edge& edge, double parentWidth, bool isParentOnBorder, double outward) noexcept {
    if (!(outward > -kSameLine * edge.width)) return;
    edge.width = std::max(edge.width, parentWidth);
    edge.isOnBorder = isParentOnBorder;
}

TileEdges::Border borderOfRoot(const GeodeticBin& tile) noexcept {
    const bool isAround = tile.longitude().width() > 2.0 * kPi - kSameAngle;
    const double pole = 0.5 * kPi - kSameAngle;
    return {tile.latitude().lower > -pole, !isAround, tile.latitude().upper < pole, !isAround};
}

// Of the series of a chord's poleward run, cut after its first term, for chords up to a seventh of half a turn.
constexpr double kRoomForRun = 1.1;

// The flattest curve of the surface has the largest radius of curvature; posts as high as `altitude` stand above it.
double largestRadius(const Ellipsoid& ellipsoid, double altitude) noexcept {
    const double largest = largestCurvatureRadius(ellipsoid);
    return std::max(kRoomForAltitude * largest, largest + altitude);
}

// Largest change of latitude for a run towards the axis, where posts may be as low as `altitude`.
double mostTurn(const Ellipsoid& ellipsoid, double altitude) noexcept {
    const double a = ellipsoid.equatorialRadius();
    const double flattening = std::max(1.0, a / ellipsoid.polarRadius());
    const double meridional = a / (flattening * flattening);
    const double below = std::clamp(-altitude - (kRoomForAltitude - 1.0) * a, 0.0, kDeepestPost * meridional);
    return below > 0.0 ? (a - below) / (meridional - below) : flattening * flattening;
}

// The poleward run of a chord between two posts `angle` apart on a parallel: source doc/theory/tiles.md, (4.3).
double polewardRun(const Ellipsoid& ellipsoid, double angle, double latitude, double lowest) noexcept {
    const double half = std::min(0.5 * angle, 1.0);
    return 0.5 * kRoomForRun * mostTurn(ellipsoid, lowest) * half * half *
           std::abs(std::sin(latitude) * std::cos(latitude));
}

// The arc that sags as far as a neighbour `width` wide does along a parallel: its edge, and its triangles within the
// edge's poleward run. `slope`: the height of tiles over their width. Source: doc/theory/tiles.md, (4.2).
double arcAlongParallel(const Ellipsoid& ellipsoid, double width, double latitude, double slope,
                        double lowest) noexcept {
    const double cell = width / kFewestCells;
    const double across = 2.0 * std::sqrt(polewardRun(ellipsoid, cell, latitude, lowest) * cell * slope);
    return std::hypot(cell * std::cos(latitude), across);
}

}  // namespace

TileEdges TileEdges::of(const GeodeticBin& tile, const GeodeticBin* parentTile, const TileEdges* parentEdges) noexcept {
    const double lon = tile.longitude().width();
    const double lat = tile.latitude().width();
    TileEdges edges{lon, lat, lon, lat, {}};
    if (!parentTile || !parentEdges || parentTile->empty()) {
        edges.border = borderOfRoot(tile);
        return edges;
    }
    const GeodeticBin& p = *parentTile;
    const TileEdges& of = *parentEdges;
    TileEdges::Border& border = edges.border;
    const double east = lon / lat;
    const auto turn = [](double angle) { return std::remainder(angle, 2.0 * kPi); };
    inherit({edges.south, border.south}, of.south, of.border.south,
            (p.latitude().lower - tile.latitude().lower) * east);
    inherit({edges.north, border.north}, of.north, of.border.north,
            (tile.latitude().upper - p.latitude().upper) * east);
    inherit({edges.west, border.west}, of.west, of.border.west,
            turn(p.longitude().lower - tile.longitude().lower) / east);
    inherit({edges.east, border.east}, of.east, of.border.east,
            turn(tile.longitude().upper - p.longitude().upper) / east);
    return edges;
}

double sagOfArc(const Ellipsoid& ellipsoid, double angle, double altitude) noexcept {
    if (!(angle < kPi)) return 2.0 * std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    return largestRadius(ellipsoid, altitude) * (1.0 - std::cos(0.5 * angle));
}

double crackDepth(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges) noexcept {
    const double slope = tile.latitude().width() / tile.longitude().width();
    const double low = tile.altitude().lower;
    const double southArc = arcAlongParallel(ellipsoid, edges.south, tile.latitude().lower, slope, low);
    const double northArc = arcAlongParallel(ellipsoid, edges.north, tile.latitude().upper, slope, low);
    const double arc = std::max({southArc, northArc, edges.west / kFewestCells, edges.east / kFewestCells});
    return sagOfArc(ellipsoid, arc, tile.altitude().upper);
}

double dipBehindEdge(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges,
                     double relief) noexcept {
    const double slope = tile.latitude().width() / tile.longitude().width();
    const auto behind = [&](double width, double latitude) {
        const double cell = width / kFewestCells;
        const double run = polewardRun(ellipsoid, cell, latitude, tile.altitude().lower);
        const double height = cell * slope;
        // as in the arc of a crack's depth: a chord of height d dips by (R / 2) r d at r from its end
        const double arc = 2.0 * std::sqrt(run * height);
        return sagOfArc(ellipsoid, arc, tile.altitude().upper) + relief * std::min(1.0, run / height);
    };
    return std::max(behind(edges.south, tile.latitude().lower), behind(edges.north, tile.latitude().upper));
}

GeodeticBin withGaps(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges) noexcept {
    Interval latitude = tile.latitude();
    const double low = tile.altitude().lower;
    if (latitude.upper > 0.0) latitude.upper += polewardRun(ellipsoid, edges.north / kFewestCells, latitude.upper, low);
    if (latitude.lower < 0.0) latitude.lower -= polewardRun(ellipsoid, edges.south / kFewestCells, latitude.lower, low);
    return GeodeticBin(latitude, tile.longitude(), tile.altitude());
}

double sagOfFinerMeshes(const Ellipsoid& ellipsoid, const GeodeticBin& tile, bool areGrids) noexcept {
    const Interval& latitude = tile.latitude();
    const double nearest = latitude.contains(0.0) ? 0.0 : std::min(std::abs(latitude.lower), std::abs(latitude.upper));
    // a tile much wider than high is halved in longitude alone
    const bool isWide = tile.longitude().width() > kWide * latitude.width();
    const double height = isWide ? latitude.width() : 0.5 * latitude.width();
    const double diagonal = std::hypot(0.5 * tile.longitude().width() * std::cos(nearest), height);
    return sagOfArc(ellipsoid, areGrids ? diagonal / kFewestCells : diagonal, tile.altitude().upper);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Neighbours.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <map>
#include <utility>

namespace osgAnalyticBin::indexing {

using osgAnalyticBin::core::Interval;

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

constexpr double kTwoPi = 6.28318530717958647693;
// Of a tile's width.
constexpr double kTolerance = 1e-6;
// Margins are lengths on the ground; the smallest globe that they are turned into angles on.
constexpr double kSmallestRadius = 1.0e6;
constexpr double kMapUnitsInRadian = osgAnalyticBin::core::Ellipsoid::kMapUnitsInRadian;
constexpr double kSmallestCosine = 1e-3;

using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Item = std::pair<Box, std::uint32_t>;
using Tree = bgi::rtree<Item, bgi::quadratic<16>>;

Box boxOf(const TileRect& rect) {
    return {{rect.longitude.lower - rect.longitudeTolerance, rect.latitude.lower - rect.latitudeTolerance},
            {rect.longitude.upper + rect.longitudeTolerance, rect.latitude.upper + rect.latitudeTolerance}};
}

bool isCorner(const TileRect& a, const TileRect& b) {
    return overlap(a.latitude, b.latitude) <= a.latitudeTolerance + b.latitudeTolerance &&
           overlap(a.longitude, b.longitude) <= a.longitudeTolerance + b.longitudeTolerance;
}

TileRect shifted(TileRect rect) {
    // starts in [-pi, pi)
    return rect.turned(-kTwoPi * std::floor((rect.longitude.lower + 0.5 * kTwoPi) / kTwoPi));
}

/// Adds the neighbours of one tile, unless there is a crowd.
void addNeighbours(std::uint32_t index, const std::vector<TreeTile>& tiles, const Tree& tree, Neighbourhood& result) {
    const TileRect stored = rectOf(tiles[index].record->surface);
    const TileRect own = shifted(stored);
    std::vector<Neighbour>& neighbours = result.neighbours[index];
    std::size_t compared = 0;
    for (const double turn : {-kTwoPi, 0.0, kTwoPi}) {
        const auto box = bgi::intersects(boxOf(own.turned(-turn)));
        for (auto item = tree.qbegin(box); item != tree.qend(); ++item) {
            if (item->second == index && turn == 0.0) continue;
            if (++compared > kMostBeside) {
                result.isCrowded[index] = true;
                neighbours = {};
                break;
            }
            const TileRect other = rectOf(tiles[item->second].record->surface);
            const double whole = shifted(other).longitude.lower - other.longitude.lower + turn +
                                 stored.longitude.lower - own.longitude.lower;
            const TileRect beside = other.turned(whole);
            if (touch(stored, beside) && !isCorner(stored, beside)) neighbours.push_back({item->second, whole});
        }
        if (result.isCrowded[index]) break;
    }
    result.comparisons += compared;
    std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.tile != b.tile ? a.tile < b.tile : a.turn < b.turn;
    });
}

}  // namespace

TileRect TileRect::turned(double turn) const {
    TileRect result = *this;
    result.longitude = {longitude.lower + turn, longitude.upper + turn};
    return result;
}

TileRect rectOf(const osgAnalyticBin::TileSurface& surface) {
    TileRect rect;
    rect.latitude = surface.bin.bin().latitude();
    rect.longitude = surface.bin.bin().longitude();
    const double rounding = surface.bin.margin() / (surface.isInMap ? kMapUnitsInRadian : kSmallestRadius);
    // Rounding widens a tile where meridians are close, but narrows it only by what it is where they are apart.
    const double nearestEquator = std::max({0.0, rect.latitude.lower, -rect.latitude.upper});
    const double cosine = std::max(std::cos(nearestEquator), kSmallestCosine);
    rect.latitudeTolerance = kTolerance * rect.latitude.width() + rounding;
    rect.longitudeTolerance = kTolerance * rect.longitude.width() + rounding / cosine;
    return rect;
}

double overlap(const Interval& a, const Interval& b) {
    return std::min(a.upper, b.upper) - std::max(a.lower, b.lower);
}

bool touch(const TileRect& a, const TileRect& b) {
    return overlap(a.latitude, b.latitude) >= -(a.latitudeTolerance + b.latitudeTolerance) &&
           overlap(a.longitude, b.longitude) >= -(a.longitudeTolerance + b.longitudeTolerance);
}

Neighbourhood findNeighbours(const std::vector<TreeTile>& tiles) {
    std::map<std::uint32_t, std::vector<Item>> levels;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const osgAnalyticBin::TileSurface& surface = tiles[i].record->surface;
        if (!surface.bin.valid()) continue;
        levels[tiles[i].depth].emplace_back(boxOf(shifted(rectOf(surface))), static_cast<std::uint32_t>(i));
    }
    Neighbourhood result;
    result.neighbours.resize(tiles.size());
    result.isCrowded.resize(tiles.size(), false);
    for (const auto& level : levels) {
        const Tree tree(level.second.begin(), level.second.end());
        for (const Item& item : level.second) addNeighbours(item.second, tiles, tree, result);
    }
    return result;
}

}  // namespace osgAnalyticBin::indexing

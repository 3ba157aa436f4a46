// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Neighbours.h"

#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace osgAnalyticBin::indexing {

using core::Interval;

namespace {

constexpr double kTwoPi = 6.28318530717958647693;
// Of a tile's width.
constexpr double kTolerance = 1e-6;
// Margins are lengths on the ground; the smallest globe that they are turned into angles on.
constexpr double kSmallestRadius = 1.0e6;
constexpr double kMapUnitsInRadian = core::Ellipsoid::kMapUnitsInRadian;
constexpr double kSmallestCosine = 1e-3;

// Longitude and latitude on x and y, tolerances included.
using Box = osg::BoundingBoxd;

struct Item {
    Box box;
    std::uint32_t tile;
    Box around{};  // all items of the half that this one is the middle of
};

// Items that are halved at their middles, in turn along each axis.
class Tree {
public:
    explicit Tree(std::vector<Item> items) : _items(std::move(items)) { halve(0, _items.size(), 0); }

    // Calls `visit(tile)` for those that meet a box, as long as it returns true.
    template <class Visit>
    void visitMeeting(const Box& box, const Visit& visit) const {
        visitMeeting(box, 0, _items.size(), visit);
    }

private:
    Box halve(std::size_t first, std::size_t end, int axis) {
        const std::size_t middle = first + (end - first) / 2;
        const auto at = [this](std::size_t i) { return _items.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(first), at(middle), at(end),
                         [axis](const Item& a, const Item& b) { return a.box._min[axis] < b.box._min[axis]; });
        Box around = _items[middle].box;
        if (first < middle) around.expandBy(halve(first, middle, 1 - axis));
        if (middle + 1 < end) around.expandBy(halve(middle + 1, end, 1 - axis));
        return _items[middle].around = around;
    }

    template <class Visit>
    bool visitMeeting(const Box& box, std::size_t first, std::size_t end, const Visit& visit) const {
        if (first == end) return true;
        const std::size_t middle = first + (end - first) / 2;
        const Item& item = _items[middle];
        if (!item.around.intersects(box)) return true;
        return (!item.box.intersects(box) || visit(item.tile)) && visitMeeting(box, first, middle, visit) &&
               visitMeeting(box, middle + 1, end, visit);
    }

    std::vector<Item> _items;
};

Box boxOf(const TileRect& rect) {
    return {rect.longitude.lower - rect.longitudeTolerance, rect.latitude.lower - rect.latitudeTolerance, 0.0,
            rect.longitude.upper + rect.longitudeTolerance, rect.latitude.upper + rect.latitudeTolerance, 0.0};
}

bool isCorner(const TileRect& a, const TileRect& b) {
    return a.latitude.overlap(b.latitude) <= a.latitudeTolerance + b.latitudeTolerance &&
           a.longitude.overlap(b.longitude) <= a.longitudeTolerance + b.longitudeTolerance;
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
        tree.visitMeeting(boxOf(own.turned(-turn)), [&](std::uint32_t tile) {
            if (tile == index && turn == 0.0) return true;
            if (++compared > kMostBeside) return false;
            const TileRect other = rectOf(tiles[tile].record->surface);
            const double whole = shifted(other).longitude.lower - other.longitude.lower + turn +
                                 stored.longitude.lower - own.longitude.lower;
            const TileRect beside = other.turned(whole);
            if (touch(stored, beside) && !isCorner(stored, beside)) neighbours.push_back({tile, whole});
            return true;
        });
    }
    result.comparisons += compared;
    if (compared > kMostBeside) {
        result.isCrowded[index] = true;
        neighbours = {};
    }
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

TileRect rectOf(const TileSurface& surface) {
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

bool touch(const TileRect& a, const TileRect& b) {
    return a.latitude.overlap(b.latitude) >= -(a.latitudeTolerance + b.latitudeTolerance) &&
           a.longitude.overlap(b.longitude) >= -(a.longitudeTolerance + b.longitudeTolerance);
}

Neighbourhood findNeighbours(const std::vector<TreeTile>& tiles) {
    std::map<std::uint32_t, std::vector<Item>> levels;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TileSurface& surface = tiles[i].record->surface;
        if (!surface.bin.valid()) continue;
        levels[tiles[i].depth].push_back({boxOf(shifted(rectOf(surface))), static_cast<std::uint32_t>(i)});
    }
    Neighbourhood result;
    result.neighbours.resize(tiles.size());
    result.isCrowded.resize(tiles.size(), false);
    for (const auto& level : levels) {
        const Tree tree(level.second);
        for (const Item& item : level.second) addNeighbours(item.tile, tiles, tree, result);
    }
    return result;
}

}  // namespace osgAnalyticBin::indexing

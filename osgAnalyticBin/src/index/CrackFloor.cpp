// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CrackFloor.h"

#include "Neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace osgAnalyticBin::indexing {

using core::Interval;

namespace {

constexpr double kHalfPi = 1.57079632679489661923;
// Part of an edge that may be without a neighbour at its ends: chords and simplified meshes end short of it.
constexpr double kEdgeSlack = 1e-3;
// Meshes of coarse tiles bulge over an edge that they share by a few percent.
constexpr double kBesideOverlap = 0.25;

enum Edge { South, East, North, West };

double lowestEdge(const TileSurface& surface) {
    return *std::min_element(surface.edgeLow.begin(), surface.edgeLow.end());
}

double shareOf(const Interval& a, const Interval& b) {
    const double width = std::min(a.width(), b.width());
    return width > 0.0 ? a.overlap(b) / width : 1.0;
}

/// The lowest altitude of two tiles along the edge between them, or of all their edges where that edge is not clear.
double facingLow(const TileSurface& a, const TileRect& aRect, const TileSurface& b, const TileRect& bRect) {
    const bool isBesideInLongitude = shareOf(aRect.longitude, bRect.longitude) < kBesideOverlap;
    const bool isBesideInLatitude = shareOf(aRect.latitude, bRect.latitude) < kBesideOverlap;
    if (isBesideInLongitude == isBesideInLatitude) return std::min(lowestEdge(a), lowestEdge(b));
    if (isBesideInLongitude) {
        const bool isEast = bRect.longitude.middle() > aRect.longitude.middle();
        return isEast ? std::min(a.edgeLow[East], b.edgeLow[West]) : std::min(a.edgeLow[West], b.edgeLow[East]);
    }
    const bool isNorth = bRect.latitude.middle() > aRect.latitude.middle();
    return isNorth ? std::min(a.edgeLow[North], b.edgeLow[South]) : std::min(a.edgeLow[South], b.edgeLow[North]);
}

/// Which parts of a tile's four edges have a neighbour.
class EdgeCover {
public:
    explicit EdgeCover(const TileRect& tile) : _tile(tile) {}

    void add(const TileRect& other) {
        const double lat = _tile.latitudeTolerance + other.latitudeTolerance;
        const double lon = _tile.longitudeTolerance + other.longitudeTolerance;
        if (other.latitude.lower < _tile.latitude.lower - lat) _parts[South].push_back(other.longitude);
        if (other.latitude.upper > _tile.latitude.upper + lat) _parts[North].push_back(other.longitude);
        if (other.longitude.lower < _tile.longitude.lower - lon) _parts[West].push_back(other.latitude);
        if (other.longitude.upper > _tile.longitude.upper + lon) _parts[East].push_back(other.latitude);
    }

    [[nodiscard]] bool isWhole() {
        const double pole = kHalfPi - _tile.latitudeTolerance;
        return (_tile.latitude.lower <= -pole || covers(_parts[South], _tile.longitude, _tile.longitudeTolerance)) &&
               (_tile.latitude.upper >= pole || covers(_parts[North], _tile.longitude, _tile.longitudeTolerance)) &&
               covers(_parts[East], _tile.latitude, _tile.latitudeTolerance) &&
               covers(_parts[West], _tile.latitude, _tile.latitudeTolerance);
    }

private:
    static bool covers(std::vector<Interval>& parts, const Interval& edge, double tolerance) {
        std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.lower < b.lower; });
        const double slack = tolerance + kEdgeSlack * edge.width();
        double end = edge.lower;
        for (const Interval& part : parts) {
            if (part.lower > end + slack) return false;
            end = std::max(end, part.upper);
        }
        return end >= edge.upper - slack;
    }

    const TileRect& _tile;
    std::array<std::vector<Interval>, 4> _parts;
};

class CrackFloors {
public:
    explicit CrackFloors(const std::vector<TreeTile>& tiles)
        : _tiles(tiles), _beside(findNeighbours(tiles)), _lastSeenFor(tiles.size(), kNone) {}

    [[nodiscard]] AnalyticBin binOf(std::uint32_t index) {
        const TreeTile& tile = _tiles[index];
        if (!tile.isKnown) return {};
        Floor floor{tile.united.bin().altitude().lower, tile.united.sag(), true};
        lowerToSameDepth(index, floor);
        lowerToCoarser(index, floor);
        if (!floor.isKnown || floor.low < tile.skirtLow) {
            floor.low = std::min(tile.skirtLow, tile.united.bin().altitude().lower);
            floor.sag = std::max(tile.united.sag(), tile.skirt);
        }
        AnalyticBin bin = tile.united;
        bin.setBin(bin.bin().withAltitude({floor.low, bin.bin().altitude().upper}));
        bin.setSag(floor.sag);
        return bin;
    }

    /// Number of pairs of tiles that were compared.
    [[nodiscard]] std::size_t comparisons() const { return _beside.comparisons + _steps; }

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    // Most steps for one tile; quadtrees need some hundreds. With more, the whole skirt counts.
    static constexpr std::size_t kMostSteps = 4096;

    struct Floor {
        double low;
        double sag;
        bool isKnown;
    };

    void lowerToSameDepth(std::uint32_t index, Floor& floor) const {
        floor.isKnown = floor.isKnown && !_beside.isCrowded[index];
        for (const Neighbour& neighbour : _beside.neighbours[index]) {
            const TreeTile& other = _tiles[neighbour.tile];
            floor.isKnown = floor.isKnown && other.isKnown;
            if (!other.isKnown) return;
            floor.low = std::min(floor.low, other.united.bin().altitude().lower);
            floor.sag = std::max(floor.sag, other.united.sag());
        }
    }

    void lowerToCoarser(std::uint32_t index, Floor& floor) {
        if (!floor.isKnown) return;
        const TileRect own = rectOf(_tiles[index].record->surface);
        EdgeCover cover(own);
        const auto line = lineOf(index);
        floor.isKnown = line.has_value();
        if (!line) return;
        for (const std::uint32_t ancestor : *line) {
            const TileSurface& surface = _tiles[ancestor].record->surface;
            const TileRect rect = besideOf(own, rectOf(surface));
            const double turn = rect.longitude.lower - surface.bin.bin().longitude().lower;
            for (const Neighbour& neighbour : _beside.neighbours[ancestor]) {
                const TileSurface& other = _tiles[neighbour.tile].record->surface;
                const TileRect otherRect = rectOf(other).turned(neighbour.turn + turn);
                if (!touch(own, otherRect)) continue;
                cover.add(otherRect);
                floor.low = std::min(floor.low, facingLow(surface, rect, other, otherRect));
                floor.sag = std::max({floor.sag, surface.bin.sag(), other.bin.sag()});
            }
        }
        floor.isKnown = floor.isKnown && cover.isWhole();
    }

    /// The tile and all its ancestors of known surface, each once.
    /// Returns: nullopt when they and their neighbours are too many.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> lineOf(std::uint32_t index) {
        std::vector<std::uint32_t> line{index};
        _lastSeenFor[index] = index;
        std::size_t steps = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::uint32_t tile = line[i];
            steps += 1 + _tiles[tile].parents.size() + _beside.neighbours[tile].size();
            if (steps > kMostSteps || _beside.isCrowded[tile]) return std::nullopt;
            for (const std::uint32_t parent : _tiles[tile].parents) {
                if (std::exchange(_lastSeenFor[parent], index) != index) line.push_back(parent);
            }
        }
        _steps += steps;
        const auto isUnknown = [this](std::uint32_t tile) { return !_tiles[tile].record->surface.bin.valid(); };
        line.erase(std::remove_if(line.begin(), line.end(), isUnknown), line.end());
        return line;
    }

    /// An ancestor's rectangle, turned so that it lies about the tile's.
    static TileRect besideOf(const TileRect& tile, const TileRect& ancestor) {
        constexpr double kTwoPi = 4.0 * kHalfPi;
        const double distance = tile.longitude.middle() - ancestor.longitude.middle();
        return ancestor.turned(kTwoPi * std::round(distance / kTwoPi));
    }

    const std::vector<TreeTile>& _tiles;
    Neighbourhood _beside;
    std::vector<std::uint32_t> _lastSeenFor;
    std::size_t _steps = 0;
};

}  // namespace

std::vector<AnalyticBin> binsWithCracks(const std::vector<TreeTile>& tiles, std::size_t* comparisons) {
    CrackFloors floors(tiles);
    std::vector<AnalyticBin> bins;
    bins.reserve(tiles.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) bins.push_back(floors.binOf(static_cast<std::uint32_t>(i)));
    if (comparisons) *comparisons = floors.comparisons();
    for (std::size_t i = tiles.size(); i-- > 0;) {
        for (const std::uint32_t parent : tiles[i].parents) {
            if (bins[parent].valid()) bins[parent].expandBy(bins[i]);
        }
    }
    return bins;
}

}  // namespace osgAnalyticBin::indexing

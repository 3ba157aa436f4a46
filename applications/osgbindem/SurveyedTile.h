// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemSource.h"
#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace osgbindem {

/// What a database is made of, in numbers; of the finest posts each counts once, edges aside.
struct Tally {
    double tiles = 0.0;
    double deepest = 0.0;
    double files = 0.0;
    double bytes = 0.0;
    double posts = 0.0;
    /// Posts in voids, and those at 0 m because no raster has data there.
    double filled = 0.0;
    double missing = 0.0;

    struct Extreme {
        double metres = 0.0;
        PositionDeg position;
    };
    Extreme lowest{std::numeric_limits<double>::infinity(), {}};
    Extreme highest{-std::numeric_limits<double>::infinity(), {}};

    /// Of a post with data or in a void.
    void addHeight(double metres, const PositionDeg& position) noexcept {
        if (metres < lowest.metres) lowest = {metres, position};
        if (metres > highest.metres) highest = {metres, position};
    }
    void add(const Tally& other) noexcept {
        tiles += other.tiles;
        deepest = std::max(deepest, other.deepest);
        files += other.files;
        bytes += other.bytes;
        posts += other.posts;
        filled += other.filled;
        missing += other.missing;
        if (other.lowest.metres < lowest.metres) lowest = other.lowest;
        if (other.highest.metres > highest.metres) highest = other.highest;
    }
};

/// A tile with everything below it in files: what its mesh and the tiles above need of it.
struct SurveyedTile {
    TileId id;
    /// The tile as it is stored, but for its colours.
    osgAnalyticBin::TerrainGrid grid;
    /// The full-resolution heights under the tile.
    Interval range = Interval::none();
    /// Of the tile and everything below it.
    Tally tally;
    /// Holds the bins of all tiles below; not valid for a tile without children.
    osgAnalyticBin::AnalyticBin below;
    /// What the files below the tile add up to, in whatever order they were written or read back.
    std::uint64_t checksum = 0;
};

}  // namespace osgbindem

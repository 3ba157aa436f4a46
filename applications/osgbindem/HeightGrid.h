// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "RasterGrid.h"
#include "TileLayout.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

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
    void add(const Tally& other) noexcept;

    /// Lines for the user, without the last line's end. `seconds`: the time that it took.
    [[nodiscard]] std::string text(const std::string& name, int startLevel, double seconds) const;
    /// A warning; empty where no data is missing.
    [[nodiscard]] std::string warning() const;

    template <class Stream, class Record>
    static void pass(Stream& s, Record& tally) {
        for (auto* number :
             {&tally.tiles, &tally.deepest, &tally.files, &tally.bytes, &tally.posts, &tally.filled, &tally.missing}) {
            s.number(*number);
        }
        for (auto* extreme : {&tally.lowest, &tally.highest}) {
            s.number(extreme->metres);
            s.number(extreme->position.latitudeDeg);
            s.number(extreme->position.longitudeDeg);
        }
    }
};

/// The heights of a tile's posts and of one ring of posts around them, which the normals need.
/// Columns and rows of the tile run from 0 to cells(), those of the ring are -1 and cells() + 1.
class HeightGrid final {
public:
    HeightGrid(const TileId& tile, const TileLayout& layout);

    [[nodiscard]] const TileId& tile() const noexcept { return _tile; }
    [[nodiscard]] int cells() const noexcept { return _cells; }
    [[nodiscard]] double at(int column, int row) const noexcept { return _heights[index(column, row)]; }

    /// Takes every post of the tile from the rasters, in whole steps of osgAnalyticBin::TerrainGrid.
    /// Returns: what was found, without the posts at the northern and eastern edge.
    Tally sample(DemMosaic& mosaic, const TileLayout& layout);

    /// Takes every other post of a child: they are this tile's posts.
    void takeFrom(const HeightGrid& child);

    void sampleRing(DemMosaic& mosaic, const TileLayout& layout);

    /// All heights with the ring, row by row from the south-west, to be stored and read back, as many.
    [[nodiscard]] const std::vector<double>& values() const noexcept { return _heights; }
    [[nodiscard]] std::vector<double>& values() noexcept { return _heights; }

    /// Lowest and highest post of the tile.
    [[nodiscard]] HeightRange range() const noexcept;

private:
    [[nodiscard]] std::size_t index(int column, int row) const noexcept {
        return static_cast<std::size_t>((row + 1) * (_cells + 3) + column + 1);
    }
    std::optional<DemMosaic::Found> samplePost(DemMosaic& mosaic, const TileLayout& layout, int column, int row);

    TileId _tile;
    int _cells;
    std::vector<double> _heights;
};

}  // namespace osgbindem

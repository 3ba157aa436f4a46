// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "Tally.h"
#include "TileLayout.h"

#include <optional>
#include <vector>

namespace osgbindem {

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

    /// All heights with the ring, row by row from the south-west, to be stored.
    [[nodiscard]] const std::vector<double>& values() const noexcept { return _heights; }

    /// Takes heights that were stored. Returns: false when there are too many or too few.
    [[nodiscard]] bool setValues(std::vector<double> values);

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

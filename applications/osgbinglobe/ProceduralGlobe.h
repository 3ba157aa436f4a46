// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GlobeOptions.h"
#include "ProceduralTerrain.h"
#include "TerrainGrid.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Node>

#include <Tile.h>
#include <TileLayout.h>
#include <cstdint>

namespace osgAnalyticBin::globe {

/// A paged globe of terrain that a formula makes, in the layout of osgbindem: WGS 84, quadtrees below 16 x 8 tiles,
/// skirts, a bin with each tile; heights are in whole steps of TerrainGrid. Tiles that meet at one level share their
/// edges to the last bit.
/// Threads: const members may be called by any number of threads at once.
class ProceduralGlobe final {
public:
    explicit ProceduralGlobe(const GlobeOptions& options);

    /// The CoordinateSystemNode with the start tiles, which declares below what nothing is drawn.
    [[nodiscard]] osg::ref_ptr<osg::Node> root() const;

    /// A Group with the four quarters of a tile. Requires: a tile above the deepest level.
    /// Cost: some half a millisecond with 16 cells.
    [[nodiscard]] osg::ref_ptr<osg::Node> children(const tiles::TileId& tile) const;

    /// Of the tile and all below it, skirts included.
    /// Guarantee: holds every triangle of the tile and the bins of its children; tests: ProceduralGlobe.*.
    [[nodiscard]] AnalyticBin binOf(const tiles::TileId& tile) const;

    /// Metres that the skirts of a level hang down: as far as the edges of neighbours one level coarser, or any number
    /// finer, can be apart.
    [[nodiscard]] double skirtDepth(int level) const noexcept;

    [[nodiscard]] const tiles::TileLayout& layout() const noexcept { return _layout; }
    [[nodiscard]] const ProceduralTerrain& terrain() const noexcept { return _terrain; }

private:
    [[nodiscard]] bool hasChildren(const tiles::TileId& tile) const noexcept { return tile.level < _options.levels; }
    [[nodiscard]] double edgeError(int level) const noexcept;
    [[nodiscard]] std::int32_t skirtLean(int level) const noexcept;
    [[nodiscard]] TerrainGrid gridOf(const tiles::TileId& tile) const;
    [[nodiscard]] AnalyticBin binOf(const tiles::TileId& tile, const core::Interval& own) const;
    [[nodiscard]] core::GeodeticBin meshBox(const tiles::TileId& tile, int level, const core::Interval& heights) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> tileNode(const tiles::TileId& tile, tiles::SharedParts& shared) const;

    GlobeOptions _options;
    tiles::TileLayout _layout;
    ProceduralTerrain _terrain;
};

}  // namespace osgAnalyticBin::globe

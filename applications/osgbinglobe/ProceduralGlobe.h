// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GlobeOptions.h"
#include "TerrainGrid.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <osg/Node>

#include <Tile.h>
#include <TileLayout.h>
#include <array>
#include <cstdint>

namespace osgAnalyticBin::globe {

/// Heights for the whole globe, the same at every call: a sum of plane waves through the sphere of directions, from
/// 5000 km down to 4 m long, longer ones higher. Continuous everywhere, poles and date line included.
/// Frame: geodetic latitude and longitude; metres above the ellipsoid.
/// Cost: one sine for each of the 31 waves.
class ProceduralTerrain final {
public:
    /// `relief`: metres; heights lie in 0 .. relief.
    explicit ProceduralTerrain(double relief) noexcept;

    [[nodiscard]] double height(const tiles::PositionDeg& position) const noexcept;

    /// Bounds of the heights in a rectangle, wave by wave: the narrower the rectangle, the tighter.
    /// Guarantee: holds every height; that of a part of a rectangle lies within that of the whole, up to a
    /// micrometre; tests: ProceduralTerrain.*.
    [[nodiscard]] core::Interval heightsIn(const tiles::RectDeg& rect) const noexcept;

    /// Upper bound in metres of how far heights between two posts of a meridian or parallel are from the straight
    /// line between those of the posts. `spacing`: radians.
    [[nodiscard]] double interpolationError(double spacing) const noexcept;

private:
    static constexpr std::size_t kWaves = 31;

    struct Wave {
        glm::dvec3 direction{0.0};  // unit
        double frequency = 0.0;     // radians for each radius
        double phase = 0.0;
        double amplitude = 0.0;
    };

    double _middle;
    std::array<Wave, kWaves> _waves;
};

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

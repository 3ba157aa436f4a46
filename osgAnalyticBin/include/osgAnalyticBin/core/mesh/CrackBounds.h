// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <array>

namespace osgAnalyticBin::core {

/// For the four edges of a tile in a quadtree: the width in radians of the largest tile with an edge on the same line.
/// A neighbour beyond that line may be as wide.
/// Source: doc/theory/tiles.md, section 4.
struct TileEdges {
    /// @{
    /// Radians; 0: no tile is as wide.
    double south = 0.0, east = 0.0, north = 0.0, west = 0.0;
    /// @}

    /// Whether the edge is a part of the database's outer border: there is no neighbour, and skirts stand in plain
    /// view.
    struct Border {
        /// @{
        /// Edge by edge.
        bool south = false, east = false, north = false, west = false;
        /// @}
    };
    /// Default: none.
    Border border;

    /// Whether any edge is on the border.
    [[nodiscard]] bool areOnBorder() const noexcept {
        return border.south || border.east || border.north || border.west;
    }

    /// The edges of a tile, `parent` being those of the tile that it is a part of (null or empty: a root). Edges of
    /// roots are on the border unless they lie at a pole or their tile runs around the globe; other roots beside it do
    /// not count.
    [[nodiscard]] static TileEdges of(const GeodeticBin& tile, const GeodeticBin* parentTile,
                                      const TileEdges* parentEdges) noexcept;
};

/// The smallest number of cells along an edge that is assumed for meshes of unknown databases. VirtualPlanetBuilder's
/// flat tiles have this many.
constexpr int kFewestCells = 7;

/// Metres by which the chord of an arc of `angle` radians sags below its ends at most, where these are no higher than
/// `altitude` or a hundredth of the radii.
/// Source: doc/theory/tiles.md, (4.1).
[[nodiscard]] double sagOfArc(const Ellipsoid& ellipsoid, double angle, double altitude = 0.0) noexcept;

/// How far below its posts a coarser neighbour can dip where it meets the tile's edges, metres: to that depth an eye
/// above the terrain can see the tile's skirts. Zero or more.
/// Assumes: neighbours have kFewestCells cells along an edge or more, and the tile's proportions; posts within a
/// hundredth of the radii of the ellipsoid, 60 km on the earth, or within the tile's altitudes.
/// Guarantee: on any ellipsoid in any unit; tests: CrackBounds.*.
[[nodiscard]] double crackDepth(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges) noexcept;

/// Extra depth in metres for floors that were estimated from edges only: an upper bound of how far the triangles of a
/// coarser neighbour, within its edge's poleward run, dip below the lowest point of the edge. `relief`: metres by which
/// a mesh may be lower than its edge.
/// Assumes: as crackDepth(). Source: doc/theory/tiles.md, (4.5).
[[nodiscard]] double dipBehindEdge(const Ellipsoid& ellipsoid, const GeodeticBin& tile, const TileEdges& edges,
                                   double relief) noexcept;

/// The tile's bin, widened poleward by the gap that opens between it and the chords of a coarser neighbour's posts on
/// their common parallel: through that gap its skirts are seen to any depth.
/// Assumes: as crackDepth().
[[nodiscard]] GeodeticBin withGaps(const Ellipsoid& ellipsoid, const GeodeticBin& tile,
                                   const TileEdges& edges) noexcept;

/// How far below its posts a mesh on a part of the tile, half as wide, can dip, metres: one triangle may cover it all,
/// or, where meshes are grids, a cell. The part is half as high too, unless the tile is much wider than high.
/// Assumes: grids have kFewestCells cells along an edge or more.
[[nodiscard]] double sagOfFinerMeshes(const Ellipsoid& ellipsoid, const GeodeticBin& tile, bool areGrids) noexcept;

}  // namespace osgAnalyticBin::core

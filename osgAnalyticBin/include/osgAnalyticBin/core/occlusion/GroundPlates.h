// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::core {

struct PlateBounds;

/// Convex bodies within the earth below a terrain's surface, in rows of numbers for vectors: each is the hull of the
/// corners of a cell, in metres, in the frame that GroundPlates::columns() was given.
struct EarthColumns {
    /// More than the cells of all grids in a quarter of a tile.
    static constexpr std::size_t kMost = 24;

    /// Number of columns.
    std::size_t size = 0;
    /// Rows of x, y and z of the south-western, south-eastern, north-western and north-eastern upper corners, then of
    /// the lower ones.
    std::array<double, 24 * kMost> corners{};
    /// Metres by which each corner may be wrong. NaN: nothing is known of the cell, and the column hides nothing.
    std::array<double, kMost> error{};
};

/// Lower bounds of the altitude of a tile's surface, cell by cell, in grids of 1, 2, 4 and 8 cells a side over the
/// tile's latitudes and longitudes. Each cell has a rim that its column of earth keeps out of: room for the chords of
/// parallels, and for triangles of the next cell whose chords cross the common edge.
/// An upper bound for each of 16 parts of the tile tells how far up its mesh reaches there.
/// Memory: 322 bytes, 16 bits for each bound.
/// Source: doc/theory/occlusion.md, sections 2 and 3.
class GroundPlates final {
public:
    /// Cells a side of the finest grid.
    static constexpr std::size_t kFinest = 8;
    /// The quarters of the quarters: part 4 q + p is quarter p of quarter q, both numbered as BinBody::quarters() does.
    static constexpr std::size_t kParts = 16;

    /// Nothing is known.
    GroundPlates() noexcept;

    /// Of a mesh that lies within the extents; their altitudes are ignored. `cover`: MeshCover::of() the mesh. Nothing
    /// is known unless the mesh fills its place; a cell is known where no end of the mesh reaches into it. `margin`:
    /// how many metres away from its place the mesh may be drawn. Bounds are lowered by the margin. Nothing is known if
    /// it is wider than a tenth of a rim. Cost: some 0.1 microseconds for each triangle. Requires: indices within the
    /// vertices.
    GroundPlates(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const MeshCover& cover, const GeodeticBin& extents,
                 double margin = 0.0);

    /// Of a grid with triangles between its posts, the diagonal of each of its cells either way, front faces up.
    /// `altitudes`: metres, of the posts, row by row from the south-west; `margin` as above; `skirt`: how many metres
    /// skirts hang from the border, within 3 degrees of straight down: no tops are known if these are deeper than half
    /// of the grid's width. All cells are known or none: where posts are too far apart, fewer than three a side, or at
    /// a pole. Guarantee: that of a mesh with any choice of diagonals; tests: GroundPlates.*OfAGrid*. Cost: some 10
    /// nanoseconds for each post. Requires: an altitude for each post.
    GroundPlates(const Ellipsoid& ellipsoid, const GeodeticGrid& grid, const std::vector<double>& altitudes,
                 double margin = 0.0, double skirt = 0.0);

    /// Whether a column can be made of any cell.
    [[nodiscard]] bool isKnown() const noexcept;

    /// Metres, of a cell in the grid of `cells` cells a side, 1, 2, 4 or 8; rows run north, columns east. Minus
    /// infinity: not known. Requires: such a grid and cell.
    [[nodiscard]] double least(std::size_t cells, std::size_t row, std::size_t column) const noexcept;

    /// Metres: the mesh and its skirts are nowhere higher in a part of `bin`, which holds them. Infinity: not known, or
    /// the bin has other parts than the mesh. Guarantee: tests: GroundPlates.TopsAreAbove*. Requires: part < kParts.
    /// Source: doc/theory/occlusion.md, section 3.
    [[nodiscard]] double most(std::size_t part, const GeodeticBin& bin) const noexcept;
    /// The same of the four parts of a quarter. Requires: quarter < 4.
    [[nodiscard]] double mostOfQuarter(std::size_t quarter, const GeodeticBin& bin) const noexcept;

    /// Makes a column of earth, `depth` metres deep, for each cell in one quarter of the tile, of the grids of
    /// `coarsest` cells a side to `finest`, row by row, in the coordinates of `frame`. Quarters are numbered as
    /// BinBody::quarters() does. The single cell of the coarsest grid belongs to all quarters. Cells of the other grids
    /// are left out unless they are higher, by more than `worth` metres, than the cell of the next coarser grid that
    /// holds them.
    /// Guarantee: every point of a column, up to its `error`, has the mesh above it, along the ellipsoid's normal;
    /// tests: GroundPlates.ColumnsLieBelowTheMesh*. Corners are where their latitude, longitude and altitude are, up to
    /// the error; test: GroundPlates.CornersOfColumnsAreWrongByTheirErrorAtMost. Nothing is known of cells too wide for
    /// the rim: with angles in radians, where the square of the width in longitude exceeds about an eleventh of the
    /// width in latitude; nor of tiles wider than a radian.
    /// Requires: `finest` and `coarsest` as in least(). Cost: a few nanoseconds a column.
    void columns(std::size_t finest, std::size_t coarsest, std::size_t quarter, double depth, double worth,
                 const InverseFrame& frame, EarthColumns& columns) const noexcept;

private:
    [[nodiscard]] bool fitsColumns(std::size_t cells) const noexcept;
    [[nodiscard]] double shallowest() const noexcept;

    static constexpr std::size_t kNumbers = 1 + 4 + 16 + 64;

    class Builder;

    /// Nothing is known yet.
    GroundPlates(const Ellipsoid& ellipsoid, const Interval& latitude, const Interval& longitude) noexcept;
    [[nodiscard]] bool mayStandBeside(double margin) const noexcept;
    [[nodiscard]] double narrowest() const noexcept;
    [[nodiscard]] bool mayHang(double skirt) const noexcept;
    [[nodiscard]] bool hasPartsOf(const GeodeticBin& bin) const noexcept;
    [[nodiscard]] double top(std::size_t part) const noexcept;
    // `found`: infinity for parts that are not known.
    void encode(const PlateBounds& found, double margin) noexcept;
    void raise(std::size_t part, double altitude) noexcept;

    [[nodiscard]] double decoded(std::uint16_t code) const noexcept {
        return _base + _step * static_cast<double>(code);
    }

    Ellipsoid _ellipsoid;
    Interval _latitude, _longitude;
    std::array<double, 4> _middle{};             // sine and cosine of the middle latitude, then longitude
    double _base = 0.0, _step = 0.0;             // of the codes
    std::uint8_t _fitting = 0;                   // the grids, by their cells a side, whose cells have columns
    std::array<std::uint16_t, kNumbers> _least;  // 0: not known
    std::array<std::uint16_t, kParts> _most{};   // 0: not known
};

}  // namespace osgAnalyticBin::core

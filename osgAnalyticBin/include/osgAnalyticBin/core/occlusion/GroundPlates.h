// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/mesh/QuickMeshBounds.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace osgAnalyticBin::core {

/// A convex body within the earth below a terrain's surface: the hull of eight corners, ECEF.
struct EarthColumn {
    /// @{
    /// The corners of a cell, south-west, south-east, north-west, north-east.
    std::array<glm::dvec3, 4> top, bottom;
    /// @}
    /// Metres by which each corner may be wrong.
    double error = 0.0;
};

/// Lower bounds of the altitude of a tile's surface, cell by cell, in grids of 1, 2, 4 and 8 cells a side over the
/// tile's latitudes and longitudes. Each cell has a rim that its column of earth keeps out of: room for the chords of
/// parallels, and for triangles of the next cell whose chords cross the common edge.
/// Source: doc/occlusion.md, sections 2 and 3.
class GroundPlates final {
public:
    /// Nothing is known.
    GroundPlates() noexcept;

    /// Of a mesh that lies within the extents; their altitudes are ignored. A cell is known where the mesh covers all
    /// of it, and where all triangles face the same way, up or down.
    /// Cost: one or two microseconds for each triangle. Requires: indices within the vertices.
    GroundPlates(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& extents);

    /// Metres, of a cell in the grid of `cells` cells a side, 1, 2, 4 or 8; rows run north, columns east. Minus
    /// infinity: not known. Requires: such a grid and cell.
    [[nodiscard]] float least(std::size_t cells, std::size_t row, std::size_t column) const noexcept;

    /// The earth below a known cell, `depth` metres deep.
    /// Guarantee: every point of it, up to `error`, has the mesh above it, along the ellipsoid's normal; tests:
    /// GroundPlates.ColumnsLieBelowTheMesh*.
    /// Returns: nullopt where nothing is known, and for cells too wide for the rim: with angles in radians, where the
    /// square of the width in longitude exceeds about an eighth of the width in latitude. Requires: as least().
    [[nodiscard]] std::optional<EarthColumn> column(std::size_t cells, std::size_t row, std::size_t column,
                                                    double depth) const noexcept;

private:
    static constexpr std::size_t kNumbers = 1 + 4 + 16 + 64;

    class Builder;

    Ellipsoid _ellipsoid;
    Interval _latitude, _longitude;
    std::array<float, kNumbers> _least;
};

}  // namespace osgAnalyticBin::core

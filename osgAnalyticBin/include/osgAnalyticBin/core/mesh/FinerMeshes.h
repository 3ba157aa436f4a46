// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

namespace osgAnalyticBin::core {

/// The smallest number of cells along an edge that is assumed for grids that are not loaded. VirtualPlanetBuilder's
/// flat tiles have this many.
constexpr int kFewestCells = 7;

/// Metres by which the chord of an arc of `angle` radians sags below its ends at most, where these are no higher than
/// `altitude` or a hundredth of the radii.
/// Source: doc/theory/tiles.md, (2.1).
[[nodiscard]] double sagOfArc(const Ellipsoid& ellipsoid, double angle, double altitude = 0.0) noexcept;

/// How far below its posts a mesh on a part of the tile, half as wide, can dip, metres: one triangle may cover it all,
/// or, where meshes are grids, a cell. The part is half as high too, unless the tile is much wider than high.
/// Assumes: grids have kFewestCells cells along an edge or more.
/// Guarantee: on any ellipsoid in any unit; tests: FinerMeshes.*.
/// Source: doc/theory/tiles.md, (2.2).
[[nodiscard]] double sagOfFinerMeshes(const Ellipsoid& ellipsoid, const GeodeticBin& tile, bool areGrids) noexcept;

}  // namespace osgAnalyticBin::core

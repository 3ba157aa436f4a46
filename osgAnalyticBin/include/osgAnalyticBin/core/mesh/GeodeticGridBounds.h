// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <cstddef>

namespace osgAnalyticBin::core {

/// A mesh whose posts are evenly spaced in latitude and longitude, the first and last on the edges of the rectangle;
/// between them stand triangles with the diagonal either way.
/// Requires: at least two columns and rows, cells of at most 60 by 60 degrees, latitudes within the poles (asserted).
struct GeodeticGrid {
    /// Radians, from the first row to the last.
    Interval latitude;
    /// Radians, from the first column to the last.
    Interval longitude;
    /// Posts from west to east.
    std::size_t columns = 2;
    /// Posts from south to north.
    std::size_t rows = 2;
};

/// Bounds of a grid's triangles between their posts, in closed form and for any heights. Chords sag below the posts,
/// and a chord between two posts of one parallel runs poleward of it.
/// Guarantee: where isKnown(), in any unit, for posts at altitudes within +-`reach`, every point of every triangle, and
/// the rounded posts themselves up to 1.6e-14 equatorial radii (1e-7 m on the earth), has a latitude in latitude(), a
/// longitude in the grid's, and an altitude between the lowest post's less sag() and the highest post's; the same
/// of the skirts, whose lower ends are posts, too;
/// tests: GeodeticGridBounds.*, PlanetMeshes.*.
/// Cost: some ten trigonometric functions.
/// Source: doc/theory/derivation.md, section 10.
class GeodeticGridBounds final {
public:
    /// `reach`: metres, the largest altitude of a post either way; `skirt`: metres by which skirts hang down from the
    /// posts of the border, along the normals. Requires: 0 or more (asserted).
    GeodeticGridBounds(const Ellipsoid& ellipsoid, const GeodeticGrid& grid, double reach, double skirt = 0.0) noexcept;

    /// True where |e2| is below 0.1, the reach below a tenth of the radii, and the skirt below a third, and in a map.
    /// Any other grid has no bounds, its sag is infinite, and its tile must not be culled.
    [[nodiscard]] bool isKnown() const noexcept { return _isKnown; }

    /// Radians: the grid's latitudes, and what chords run poleward of them.
    [[nodiscard]] const Interval& latitude() const noexcept { return _latitude; }

    /// Metres, of any triangle of the grid.
    [[nodiscard]] double sag() const noexcept { return _sag; }

private:
    Interval _latitude;
    double _sag = 0.0;
    bool _isKnown = true;
};

}  // namespace osgAnalyticBin::core

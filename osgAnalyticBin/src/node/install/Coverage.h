// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <vector>

namespace osgAnalyticBin {

/// What the tiles of one file cover of what they are paged below, in latitude and longitude. Areas are in square
/// radians of the map of both, not of the globe.
class Coverage {
public:
    /// The area of a rectangle.
    [[nodiscard]] static double areaOf(const core::GeodeticBin& extents);

    /// What the tiles have to cover; 0: not known.
    void expect(double area) { _expected = area; }
    void expectGlobe();
    [[nodiscard]] bool isOfGlobe() const { return _isOfGlobe; }
    /// Says that the file is loaded.
    void setVisited() { _isVisited = true; }
    void add(const core::GeodeticBin& tile);

    /// Whether the tiles of a loaded file leave out half a tile or more. Overlaps count once: coarse tiles run over
    /// their lines.
    [[nodiscard]] bool hasGap() const;

    /// What the tiles cover without such gaps, less a border of a 32nd of a tile: a mesh may leave that out along the
    /// edges of its bin. Between two latitudes and two longitudes; empty: they cover no such rectangle.
    /// Source: doc/theory/horizon.md, section 10.
    [[nodiscard]] core::GeodeticBin region() const;

private:
    [[nodiscard]] double area() const;
    [[nodiscard]] core::GeodeticBin extents() const;

    std::vector<core::GeodeticBin> _tiles;  // none crosses the date line
    double _tallest = 0.0, _widest = 0.0;   // radians of latitude and longitude
    double _smallest = 1e9;
    double _expected = 0.0;
    bool _isVisited = false, _isOfGlobe = false;
};

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <functional>
#include <utility>
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
    /// Marks the file as the root file, which is loaded.
    void expectGlobe();
    [[nodiscard]] bool isOfGlobe() const { return _isOfGlobe; }
    [[nodiscard]] bool hasTiles() const { return !_tiles.empty(); }
    /// Marks the file as loaded.
    void setVisited() { _isVisited = true; }
    void add(const core::GeodeticBin& tile);

    /// Whether the tiles of a loaded file leave out half a tile or more. Overlaps count once: coarse tiles run over
    /// their lines.
    [[nodiscard]] bool hasGap() const;

    /// Adds the rectangle that the mesh of a tile of the root file fills, found when it is asked for; empty: none is
    /// known.
    using FindFilled = std::function<core::GeodeticBin()>;
    void addMesh(FindFilled findFilled) { _meshes.push_back(std::move(findFilled)); }

    /// Whether tiles reach both poles.
    [[nodiscard]] bool reachesPoles() const;

    /// What the meshes of the root file fill together without any gap, less a border of a 32nd of a tile, because edges
    /// of meshes are made of chords. Between two latitudes and two longitudes; empty: they fill no such rectangle.
    /// Source: doc/theory/horizon.md, section 10.
    [[nodiscard]] core::GeodeticBin region() const;

private:
    [[nodiscard]] double area() const;
    [[nodiscard]] double areaWithin(const core::GeodeticBin& region) const;
    [[nodiscard]] core::GeodeticBin extents() const;

    std::vector<core::GeodeticBin> _tiles;  // none crosses the date line
    std::vector<FindFilled> _meshes;
    double _tallest = 0.0, _widest = 0.0;  // radians of latitude and longitude
    double _smallest = 1e9;
    double _expected = 0.0;
    bool _isVisited = false, _isOfGlobe = false;
};

}  // namespace osgAnalyticBin

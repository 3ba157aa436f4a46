// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <osg/ref_ptr>

#include <limits>
#include <string>
#include <vector>

namespace osgAnalyticBin {

class Database;
class InstalledTile;

/// What the tiles of one file cover of what they are paged below. A tile stands for the place of its mesh; whether the
/// mesh fills it is asked of each tile that is shown.
class Coverage {
public:
    /// For a file that is paged below a tile.
    void expect(InstalledTile& tile);
    /// Marks the file as the root file, which is loaded.
    void expectGlobe();
    /// Marks the file as loaded.
    void setVisited() { _isVisited = true; }
    /// Adds the place of a tile. `isExact`: false where another technique may draw less of it at its borders.
    void add(const core::GeodeticBin& place, bool isExact);
    /// Tells the database. Gaps in the root file are a Finding::Gap, unless it covers a region; those in a
    /// paged file are noted with the tile that pages it.
    void report(const std::string& file, Database& database) const;

private:
    // Whether the tiles of a loaded file leave out a part of what they are paged below, or of the globe. True in
    // doubt.
    [[nodiscard]] bool hasGap() const;
    // What the tiles of the root file cover together without any gap, less a border of a 32nd of a tile, because edges
    // of meshes are made of chords. Between two latitudes and two longitudes; empty: they cover no such rectangle.
    // Source: doc/theory/horizon.md, section 10.
    [[nodiscard]] core::GeodeticBin region() const;
    [[nodiscard]] bool covers(const core::GeodeticBin& place) const;
    [[nodiscard]] core::GeodeticBin extents() const;

    std::vector<core::GeodeticBin> _places;  // none crosses the date line; grown by the seams between neighbours
    double _tallest = 0.0, _widest = 0.0;    // radians of latitude and longitude
    double _smallest = std::numeric_limits<double>::infinity();  // area of a place, square radians
    core::GeodeticBin _expected;                                 // empty: not known
    osg::ref_ptr<InstalledTile> _tile;
    bool _isVisited = false, _isOfGlobe = false, _isExact = true;
};

}  // namespace osgAnalyticBin

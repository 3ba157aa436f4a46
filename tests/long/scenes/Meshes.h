// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What tiles and models draw.

#pragma once

#include "Description.h"

#include <osg/Group>

namespace osgAnalyticBin::test {

/// Extents of a tile: radians, in a map metres.
struct Extents {
    double south, north, west, east;
};

[[nodiscard]] Extents extentsOf(const DatabaseSpec& database, const TileKey& tile);

/// Metres, of a post, at vertical scale 1.
[[nodiscard]] double surfaceHeight(const DatabaseSpec& database, double latitude, double longitude);

/// A place in the database's own frame.
[[nodiscard]] osg::Vec3d place(const DatabaseSpec& database, double latitude, double longitude, double altitude);

/// From east, north and up at a place to the database's own frame.
[[nodiscard]] osg::Matrixd localFrame(const DatabaseSpec& database, double latitude, double longitude, double altitude);

/// Turns a globe about its axis, or moves a map to the east.
[[nodiscard]] osg::Matrixd turned(const DatabaseSpec& database, double amount);

/// The depth of chords between the posts of a tile below the surface at most, metres.
[[nodiscard]] double sagOf(const DatabaseSpec& database, int level);

/// The mesh of a tile whose frame is turned by an angle. `name` comes before the tile's key in the names of its nodes.
[[nodiscard]] osg::ref_ptr<osg::Node> makeMesh(const DatabaseSpec& database, const TileKey& tile, double turn,
                                               int posts, const std::string& name = "#");

/// A tower or a vehicle; `toDatabase`: from the frame that it is put in to the database's own.
[[nodiscard]] osg::ref_ptr<osg::Node> makeModel(const DatabaseSpec& database, const Part& part,
                                                const osg::Matrixd& toDatabase);

}  // namespace osgAnalyticBin::test

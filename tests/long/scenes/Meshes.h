// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What tiles and models draw.

#pragma once

#include "Description.h"

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

/// What meshes of one tile differ in.
struct MeshShape {
    int posts = 5;
    std::string name = "#";     ///< comes before the tile's key in the names of nodes
    double narrower = 0.0;      ///< this part of the tile is left free, in the east
    bool drawsNothing = false;  ///< not for osgTerrain
};

/// The mesh of a tile whose frame is turned by an angle.
[[nodiscard]] osg::ref_ptr<osg::Node> makeMesh(const DatabaseSpec& database, const TileKey& tile, double turn,
                                               const MeshShape& shape);

/// How many variants of MeshHole there are.
constexpr int kHoles = 5;

/// Does to a mesh what a part of the kinds MeshHole, ReversedFaces and Raise says.
void alterMesh(const Part& part, const DatabaseSpec& database, double turn, osg::Drawable& drawable);

/// A tower or a vehicle; `toDatabase`: from the frame that it is put in to the database's own.
[[nodiscard]] osg::ref_ptr<osg::Node> makeModel(const DatabaseSpec& database, const Part& part,
                                                const osg::Matrixd& toDatabase);

}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Transform>
#include <osg/ref_ptr>

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// The coordinate frame of a file's content, and the file that it comes from.
struct TileFrame {
    /// mapPlane() for a tile in a map. Null where there is neither a globe above nor a stored bin, and for a tile
    /// without a stored bin that may be on a globe or in a map.
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;
    osg::Matrixd localToEcef;  ///< in a map: to the map
    /// Whether the coordinate system's text names a map projection. Without an ellipsoid, the tiles are in that map;
    /// with one, their meshes decide.
    bool isProjected = false;
    /// The file that the content was read from: its path relative to the folder of the database's root file, "" for the
    /// root file itself.
    std::string file;
    bool isBelowTile = false;  ///< Whether the file is paged below a tile: then plain meshes in it are leaf tiles.
    /// Whether the application attaches the content by itself. Then `file` is a name that others may have, too.
    bool isAttached = false;

    /// Whether the frame is that of a globe or of a map.
    [[nodiscard]] bool isKnown() const { return ellipsoid || isProjected; }
};

/// A tile: a node with a stored bin (no drawable), a PagedLOD with a mesh of its own, an osgTerrain tile, or a mesh
/// beside them.
struct FoundTile {
    osg::ref_ptr<osg::Node> node;                 ///< the node that is culled
    std::vector<osg::ref_ptr<osg::Node>> meshes;  ///< what it draws itself: children that are not paged, or the node
    TileFrame frame;                              ///< the frame of `node`; its file is the one that `node` is in
    std::size_t ordinal = 0;                      ///< number of tiles before it in that file
    /// The files that are paged below it, as paths relative to the folder of the root file.
    std::vector<std::string> pagedFiles;
};

/// "a/b.osgb" and "../c/d.osgb" make "c/d.osgb": the path of a file as its referring file names it. A path that
/// leaves the folder starts with ".."; one that has a server address or is absolute stays as it is.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string pagedFilePath(const std::string& referringFile,
                                                              const std::string& name);

/// The frame of the content of a file that a node in `frame` pages under this name. `isTile`: the node is a tile.
[[nodiscard]] OSGANALYTICBIN_EXPORT TileFrame pagedFrame(const TileFrame& frame, const std::string& name, bool isTile);

/// Whether an ellipsoid's radii, metres, are finite and positive. A CoordinateSystemNode with other radii is not
/// treated as a globe, and the nodes below it are not its tiles.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool hasValidRadii(const osg::EllipsoidModel& ellipsoid);
/// The same test for two radii.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool areValidRadii(double equatorial, double polar);

/// The model that represents the plane of a map, like core::Ellipsoid::plane(): both radii are infinite.
[[nodiscard]] OSGANALYTICBIN_EXPORT const osg::EllipsoidModel* mapPlane();
/// Whether the model stands for a map, where positions have no altitudes above a globe.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isMapPlane(const osg::EllipsoidModel& ellipsoid);

/// The frame of the children of a transform that is in `frame`.
[[nodiscard]] OSGANALYTICBIN_EXPORT osg::Matrixd frameInside(const osg::Transform& node, const TileFrame& frame);

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Sets of textured meshes from oblique photographs, as ContextCapture and other programs write them: a file
// metadata.xml, and beside it a folder Data with a folder for each tile, "Data/Tile_+000_+000/Tile_+000_+000.osgb".

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/Group>
#include <osg/Node>

#include <string>
#include <vector>

namespace osgAnalyticBin {

/// Whether a root file is the metadata of a set, by its name alone: "metadata.xml".
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isMetadataName(const std::string& rootFile);

/// The files of a set on the disk.
struct PhotogrammetryFiles {
    /// The root files of the tiles, relative to the folder of the metadata, in alphabetical order.
    std::vector<std::string> roots;
    /// Folders in Data in which no root file was found.
    std::vector<std::string> withoutRoot;
};

/// Looks for the tiles of a set. The root file of the folder Data/NAME is NAME.osgb in it; where there is none, the
/// only file that all names of the folder's other files begin with. Files in Data itself are root files, too. Not for
/// servers. Returns: no roots when there is no folder Data; then `error` says so.
[[nodiscard]] OSGANALYTICBIN_EXPORT PhotogrammetryFiles findPhotogrammetryFiles(const std::string& metadataFile,
                                                                                std::string& error);

/// Declares that the tiles below a node are a photogrammetry set: installBins() then culls its LODs by boxes of their
/// vertices instead of by bins. The node is a group or a transform; everything below it is in one coordinate frame.
/// `metadataFile`: the index is expected beside this file; may be empty.
OSGANALYTICBIN_EXPORT void markPhotogrammetrySet(osg::Group& set, const std::string& metadataFile);

/// Whether markPhotogrammetrySet() was called for the node, before or after it was stored in a file.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isPhotogrammetrySet(const osg::Node& node);

/// Records the file, relative to the metadata, that a child of the set was read from.
OSGANALYTICBIN_EXPORT void setPhotogrammetryFile(osg::Node& tile, const std::string& file);

/// The file that markPhotogrammetrySet() recorded.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string metadataFileOf(const osg::Node& set);

/// The file that setPhotogrammetryFile() recorded.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string photogrammetryFileOf(const osg::Node& tile);

}  // namespace osgAnalyticBin

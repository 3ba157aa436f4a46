// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Sets of textured meshes from oblique photographs, as ContextCapture and other programs write them: a file
// metadata.xml, and beside it a folder Data with a folder for each tile, "Data/Tile_+000_+000/Tile_+000_+000.osgb".

#pragma once

#include <osgDB/Options>
#include <osgDB/ReaderWriter>

#include <string>

namespace osgAnalyticBin::plugin {

/// Whether a file is the metadata of a photogrammetry set: an XML file with the element ModelMetadata, or one of the
/// name metadata.xml.
[[nodiscard]] bool isPhotogrammetryMetadata(const std::string& path);

/// Reads the root files of all tiles of a set, and places them on the globe by its metadata. The root file of the
/// folder Data/NAME is NAME.osgb in it; where there is none, the only file that all names of the folder's other files
/// begin with. Files in Data itself are root files, too. Tiles that are missing or broken are left out, with one
/// warning. A set without a reference system stands in its own coordinates. The set is marked: markPhotogrammetrySet().
/// `options`: of the tiles; may be null.
[[nodiscard]] osgDB::ReaderWriter::ReadResult readPhotogrammetrySet(const std::string& metadataFile,
                                                                    const osgDB::Options* options);

}  // namespace osgAnalyticBin::plugin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Options>
#include <osgDB/ReaderWriter>

#include <string>

namespace osgAnalyticBin::plugin {

/// Reads the root files of all tiles of a photogrammetry set, and places them on the globe by its metadata. Tiles that
/// are missing or broken are left out, with one warning. A set without a reference system stands in its own
/// coordinates. The set is marked: markPhotogrammetrySet().
/// `options`: of the tiles; may be null.
[[nodiscard]] osgDB::ReaderWriter::ReadResult readPhotogrammetrySet(const std::string& metadataFile,
                                                                    const osgDB::Options* options);

}  // namespace osgAnalyticBin::plugin

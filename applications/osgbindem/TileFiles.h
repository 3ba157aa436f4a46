// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <osg/Node>

#include <cstdint>
#include <string>
#include <string_view>

namespace osgbindem {

/// Of the file with the children of a tile.
[[nodiscard]] std::uint64_t fileChecksum(const TileId& tile, std::string_view content) noexcept;

/// Name of a start tile, for what is kept apart for each of them: "X03_Y7".
[[nodiscard]] std::string startName(const TileId& tile);
[[nodiscard]] bool isStartName(const std::string& name);

/// Name of a tile: "L07_X12_Y345".
[[nodiscard]] std::string tileName(const TileId& tile);

/// The files with tiles, below one folder. May be used by several threads and programs at once, for different tiles.
class TileFiles final {
public:
    /// `folder`: where they are written; `finalName`: the name, without path, that it is going to have; `startLevel`:
    /// of the tiles in the root file.
    TileFiles(std::string folder, std::string finalName, int startLevel);

    /// Name of the file with the children of a tile, seen from the file that has the tile.
    [[nodiscard]] std::string childrenFile(const TileId& tile) const;

    /// Writes the file with the children of a tile. Throws Failure.
    void writeChildren(const TileId& tile, const std::string& bytes) const;

    /// The path of that file.
    [[nodiscard]] std::string pathOfChildren(const TileId& tile) const;
    [[nodiscard]] bool hasChildren(const TileId& tile) const;

    /// Reads back all files below a tile. Returns: the sum of their checksums.
    [[nodiscard]] std::uint64_t checksumBelow(const TileId& tile) const;

private:
    std::string _folder;
    std::string _finalName;
    int _startLevel;
};

/// Makes ready what OpenSceneGraph loads on first use, so that threads find everything loaded.
/// Throws Failure when the classes of a database cannot be stored.
void prepareNodeFiles();

/// The bytes of an .osgb file with the node. Throws Failure.
[[nodiscard]] std::string nodeFileBytes(const osg::Node& node, bool compress);

}  // namespace osgbindem

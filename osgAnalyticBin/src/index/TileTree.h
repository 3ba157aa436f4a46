// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// A tile of the whole database.
struct TreeTile {
    const TileRecord* record = nullptr;
    /// More than one only where a file is paged below several tiles.
    std::vector<std::uint32_t> parents;
    /// False when something of the tile, or below it, has no known surface: then `united` is of no use.
    bool isKnown = true;
    /// What the tile and all its descendants draw, skirts included.
    osgAnalyticBin::AnalyticBin united;
};

/// The tiles of all files in one tree, with what they and their descendants draw put together. Keeps pointers into the
/// records.
class TileTree final {
public:
    /// Throws Failure when a file is paged below itself, or tiles below more tiles than memory should be spent on.
    explicit TileTree(const FileRecords& records);

    /// Parents stand before their children.
    [[nodiscard]] const std::vector<TreeTile>& tiles() const { return _tiles; }

    /// Index of the first tile of a file in tiles(); the others follow.
    [[nodiscard]] std::size_t firstOf(const std::string& file) const { return _first.at(file); }

    /// Files that are missing or broken, and tiles whose own surface is not known, with the first file of each.
    struct Gaps {
        std::size_t count = 0;
        std::string first;
    };
    [[nodiscard]] const Gaps& unreadFiles() const { return _unreadFiles; }
    [[nodiscard]] const Gaps& unknownTiles() const { return _unknownTiles; }

private:
    using Parents = std::vector<std::uint32_t>;

    void addLinks(const FileRecord& record, const Parents& parents, std::map<std::string, Parents>& above) const;
    void addTiles(const FileRecord& record, const Parents& above);
    void addGaps(const FileRecord& record, const Parents& above);
    void unite();

    std::vector<TreeTile> _tiles;
    std::size_t _parentCount = 0;
    std::map<std::string, std::size_t> _first;
    Gaps _unreadFiles;
    Gaps _unknownTiles;
};

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTree.h"

#include <osgAnalyticBin/CullOptions.h>

#include <algorithm>
#include <set>

namespace osgAnalyticBin::indexing {

using core::Interval;

namespace {

// For files that cannot be read now.
constexpr Interval kTerrainAltitudes = CullOptions::kTerrainOnEarth;
// The unit of a map may be the foot.
constexpr double kFeetInMetre = 1.0 / 0.3048;
constexpr Interval kTerrainInMap{kTerrainAltitudes.lower * kFeetInMetre, kTerrainAltitudes.upper* kFeetInMetre};

/// A file that is part of a cycle, among those that could not be sorted.
std::string fileInACycle(const FileRecords& records, const std::map<std::string, std::size_t>& waiting) {
    std::map<std::string, std::string> namedBy;
    for (const auto& [file, count] : waiting) {
        for (const FileLink& link : records.at(file).links) namedBy.emplace(link.file, file);
    }
    std::string file = waiting.begin()->first;
    std::set<std::string> seen;
    while (seen.insert(file).second) file = namedBy.at(file);
    return file;
}

/// Each file after all that name it.
std::vector<const FileRecord*> sorted(const FileRecords& records) {
    std::map<std::string, std::size_t> waiting;  // links that are not settled yet, by file
    for (const auto& [file, record] : records) {
        waiting[file];
        for (const FileLink& link : record.links) ++waiting[link.file];
    }
    std::vector<const FileRecord*> order;
    const auto settle = [&](const std::string& file) {
        if (waiting.at(file) > 0) return;
        order.push_back(&records.at(file));
        waiting.erase(file);
    };
    settle("");
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const FileLink& link : order[i]->links) {
            --waiting.at(link.file);
            settle(link.file);
        }
    }
    if (waiting.empty()) return order;
    const std::string file = fileInACycle(records, waiting);
    throw Failure("\"" + (file.empty() ? "the root file" : file) +
                  "\" is paged below itself; such a database has no end");
}

// Files with many tiles that are paged below many tiles multiply their number; real terrain does not do so.
constexpr std::size_t kMostParents = 20000000;

void requireFew(std::size_t parents, const std::string& file) {
    if (parents <= kMostParents) return;
    throw Failure("\"" + file +
                  "\" and others are paged below so many tiles that no index can be made; page each file " +
                  "below one tile");
}

std::vector<std::uint32_t> withoutRepeats(std::vector<std::uint32_t> list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
}

}  // namespace

TileTree::TileTree(const FileRecords& records) {
    std::map<std::string, Parents> above;  // the tiles that a file is paged below, some more than once
    for (const FileRecord* record : sorted(records)) {
        const Parents parents = withoutRepeats(std::move(above[record->file]));
        above.erase(record->file);
        const std::size_t first = _tiles.size();
        _first[record->file] = first;
        addTiles(*record, parents);
        addGaps(*record, parents);
        addLinks(*record, parents, above);
    }
    unite();
}

void TileTree::addLinks(const FileRecord& record, const Parents& parents, std::map<std::string, Parents>& above) const {
    const auto first = static_cast<std::uint32_t>(_first.at(record.file));
    std::set<std::string> inherited;
    for (const FileLink& link : record.links) {
        Parents& list = above[link.file];
        if (link.tile >= 0) {
            list.push_back(first + static_cast<std::uint32_t>(link.tile));
        } else if (inherited.insert(link.file).second) {
            list.insert(list.end(), parents.begin(), parents.end());
        }
        if (list.size() > kMostParents) list = withoutRepeats(std::move(list));
        requireFew(list.size(), link.file);
    }
}

void TileTree::addTiles(const FileRecord& record, const Parents& above) {
    const std::size_t first = _tiles.size();
    for (const TileRecord& source : record.tiles) {
        TreeTile tile;
        tile.record = &source;
        tile.parents = source.parent < 0
                           ? above
                           : Parents{static_cast<std::uint32_t>(first + static_cast<std::size_t>(source.parent))};
        _parentCount += tile.parents.size();
        requireFew(_parentCount, record.file);
        tile.united = source.surface.bin.withSkirts(source.surface.skirt);
        tile.isKnown = tile.united.valid();
        if (!tile.isKnown && _unknownTiles.count++ == 0) _unknownTiles.first = record.file;
        _tiles.push_back(std::move(tile));
    }
}

void TileTree::addGaps(const FileRecord& record, const Parents& above) {
    if (!record.isRead && _unreadFiles.count++ == 0) _unreadFiles.first = record.file;
    if (record.isRead && !record.hasOtherContent) return;
    if (record.isRead && !above.empty() && _unknownTiles.count++ == 0) _unknownTiles.first = record.file;
    for (const std::uint32_t index : above) {
        TreeTile& tile = _tiles[index];
        if (record.isRead || !tile.isKnown) {
            tile.isKnown = false;
            continue;
        }
        const TileSurface& surface = tile.record->surface;
        const AnalyticBin missing(tile.united.bin().withAltitude(surface.isInMap ? kTerrainInMap : kTerrainAltitudes));
        tile.united.expandBy(missing.withSkirts(surface.skirt));
    }
}

void TileTree::unite() {
    for (auto child = _tiles.rbegin(); child != _tiles.rend(); ++child) {
        for (const std::uint32_t index : child->parents) {
            TreeTile& parent = _tiles[index];
            parent.isKnown = parent.isKnown && child->isKnown;
            if (parent.isKnown) parent.united.expandBy(child->united);
        }
    }
}

}  // namespace osgAnalyticBin::indexing

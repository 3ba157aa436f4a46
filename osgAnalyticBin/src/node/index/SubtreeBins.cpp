// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SubtreeBins.h"

#include <osgAnalyticBin/CullOptions.h>

#include <algorithm>
#include <set>
#include <utility>

namespace osgAnalyticBin::indexing {

namespace {

// A vertical scale moves the end of a skirt as it moves chords.
AnalyticBin withSkirt(const TileSurface& surface) {
    AnalyticBin bin = surface.bin;
    if (!bin.valid()) return bin;
    const core::Interval& altitude = bin.bin().altitude();
    bin.setBin(bin.bin().withAltitude({altitude.lower - surface.skirt, altitude.upper}));
    bin.setSag(bin.sag() + surface.skirt);
    return bin;
}

}  // namespace

void SubtreeBins::add(const FileRecord& record) {
    std::set<std::string> below;
    for (const FileLink& link : record.links) {
        if (_complete.count(link.file) == 0) below.insert(link.file);
    }
    if (below.empty()) return complete(record);
    for (const std::string& file : below) _namedBy[file].push_back(record.file);
    _waiting[record.file] = {record, below.size()};
}

void SubtreeBins::unite(const Content& inner, Content& outer, bool isTile) {
    outer.isKnown = outer.isKnown && inner.isKnown;
    outer.united.expandBy(inner.united);
    if (inner.lacksFiles && isTile && outer.united.valid())
        outer.united.expandBy(AnalyticBin(outer.united.bin().withAltitude(CullOptions::kTerrainOnEarth)));
    outer.lacksFiles = !isTile && (outer.lacksFiles || inner.lacksFiles);
}

// Publishes the bins of a file when all files below it are known. Returns: what the file and those below it draw.
SubtreeBins::Content SubtreeBins::finish(const FileRecord& record) const {
    Content whole;
    whole.isKnown = !record.isRead || !record.hasOtherContent;
    whole.lacksFiles = !record.isRead;
    std::vector<Content> tiles;
    for (const TileRecord& tile : record.tiles) {
        const AnalyticBin own = withSkirt(tile.surface);
        tiles.push_back({own, own.valid(), false});
    }
    const auto above = [&](std::int32_t tile) -> Content& {
        return tile >= 0 ? tiles[static_cast<std::size_t>(tile)] : whole;
    };
    for (const FileLink& link : record.links) unite(_complete.at(link.file), above(link.tile), link.tile >= 0);
    // tiles stand behind those above them
    for (std::size_t i = tiles.size(); i-- > 0;)
        unite(tiles[i], above(record.tiles[i].parent), record.tiles[i].parent >= 0);
    std::vector<BinIndex::Entry> entries;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const AnalyticBin& own = record.tiles[i].surface.bin;
        entries.push_back({tiles[i].isKnown ? tiles[i].united : AnalyticBin(),
                           own.valid() ? own.bin().altitude().lower : 0.0, record.tiles[i].fingerprint});
    }
    if (record.isRead) _publish(record.file, std::move(entries));
    return whole;
}

void SubtreeBins::complete(const FileRecord& first) {
    std::vector<FileRecord> ready{first};
    while (!ready.empty()) {
        const FileRecord record = std::move(ready.back());
        ready.pop_back();
        _complete[record.file] = finish(record);
        const auto above = _namedBy.find(record.file);
        if (above == _namedBy.end()) continue;
        for (const std::string& file : above->second) {
            const auto waiting = _waiting.find(file);
            if (--waiting->second.awaited > 0) continue;
            ready.push_back(std::move(waiting->second.record));
            _waiting.erase(waiting);
        }
        _namedBy.erase(above);
    }
}

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTree.h"

#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <algorithm>

namespace osgAnalyticBin::indexing {

namespace {

void warn(const TileTree::Gaps& gaps, const DatabaseFiles& files, const std::string& what, const std::string& hence,
          MadeIndex& made) {
    if (gaps.count == 0) return;
    made.warnings.push_back(std::to_string(gaps.count) + ' ' + what + ", the first in \"" + files.pathOf(gaps.first) +
                            "\"; " + hence);
}

std::vector<BinIndex::Entry> entriesOf(const FileRecord& record, const TreeTile* tile) {
    std::vector<BinIndex::Entry> entries;
    for (const TileRecord& own : record.tiles) {
        const double ownLow = own.surface.bin.valid() ? own.surface.bin.bin().altitude().lower : 0.0;
        entries.push_back({tile->isKnown ? tile->united : AnalyticBin(), ownLow, own.fingerprint});
        ++tile;
    }
    return entries;
}

}  // namespace

MadeIndex indexFrom(const DatabaseFiles& files, FileRecords records) {
    MadeIndex made;
    made.records = std::move(records);
    const TileTree tree(made.records);
    if (tree.tiles().empty()) {
        throw Failure("no tile of a globe or a map in \"" + files.rootFile() +
                      "\"; name the root file of a paged database");
    }
    made.index = new BinIndex;
    const FileStamp root = files.stampOf("");
    made.index->setSource({files.rootName(), root.size, root.time});
    for (const auto& [file, record] : made.records) {
        if (!record.isRead) continue;
        const std::size_t first = record.tiles.empty() ? 0 : tree.firstOf(file);
        made.index->setTiles(file, entriesOf(record, tree.tiles().data() + first));
    }
    warn(tree.unreadFiles(), files, "files are missing or broken",
         "the tiles above are taken to reach from -11500 m to 9000 m", made);
    warn(tree.unknownTiles(), files, "tiles have surfaces whose bounds are not known",
         "they and the tiles above them are culled by what is loaded of them, as without an index", made);
    return made;
}

}  // namespace osgAnalyticBin::indexing

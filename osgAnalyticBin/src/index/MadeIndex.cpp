// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/surface/MeshBox.h"
#include "CrackFloor.h"
#include "TileTree.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>
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

std::vector<BinIndex::Entry> entriesOf(const FileRecord& record, const AnalyticBin* bins) {
    std::vector<BinIndex::Entry> entries;
    for (const TileRecord& tile : record.tiles) {
        const double ownLow = tile.surface.bin.valid() ? tile.surface.bin.bin().altitude().lower : 0.0;
        entries.push_back({*bins++, ownLow, tile.fingerprint});
    }
    return entries;
}

MeshBox boxOf(const TileSurface& surface) {
    return surface.isEmpty ? MeshBox() : MeshBox(surface.bin);
}

// The boxes of a photogrammetry set.
class BoxUnion {
public:
    explicit BoxUnion(const FileRecords& records) : _records(records) {}

    // Those of a file's LODs, with all that is paged below them.
    std::vector<MeshBox> boxesOf(const FileRecord& record) {
        std::vector<MeshBox> boxes;
        for (const TileRecord& lod : record.tiles) boxes.push_back(boxOf(lod.surface));
        for (const FileLink& link : record.links) {
            if (link.tile >= 0) boxes[static_cast<std::size_t>(link.tile)].expandBy(wholeOf(link.file));
        }
        // children stand behind their parents
        for (std::size_t i = boxes.size(); i-- > 0;) {
            const std::int32_t parent = record.tiles[i].parent;
            if (parent >= 0) boxes[static_cast<std::size_t>(parent)].expandBy(boxes[i]);
        }
        return boxes;
    }

private:
    // All that is in a file and below it.
    MeshBox wholeOf(const std::string& file) {
        // what is paged below itself has no end
        const auto [known, isNew] = _wholes.emplace(file, MeshBox::boundless());
        if (!isNew) return known->second;
        const FileRecord& record = _records.at(file);
        MeshBox whole = record.isRead ? boxOf(record.beside) : MeshBox();
        for (const MeshBox& box : boxesOf(record)) whole.expandBy(box);
        return known->second = whole;
    }

    const FileRecords& _records;
    std::map<std::string, MeshBox> _wholes;
};

MadeIndex indexOfSet(const DatabaseFiles& files, FileRecords records) {
    MadeIndex made;
    made.index = new BinIndex;
    // it may be copied together with the set, and the metadata may be changed
    made.index->setSource({files.rootName(), 0, 0});
    records.erase("");
    TileTree::Gaps unread;
    BoxUnion boxes(records);
    for (const auto& [file, record] : records) {
        if (!record.isRead && unread.count++ == 0) unread.first = file;
        if (!record.isRead) continue;
        std::vector<BinIndex::Entry> entries;
        for (const MeshBox& box : boxes.boxesOf(record)) entries.push_back({box.bin()});
        made.index->setTiles(file, std::move(entries));
    }
    if (made.index->fileCount() == 0) throw Failure("no tile of \"" + files.rootFile() + "\" can be read");
    warn(unread, files, "files are missing or broken", "they count as empty", made);
    made.records = std::move(records);
    return made;
}

}  // namespace

MadeIndex indexFrom(const DatabaseFiles& files, FileRecords records) {
    if (isMetadataName(files.rootFile())) return indexOfSet(files, std::move(records));
    MadeIndex made;
    made.records = std::move(records);
    const TileTree tree(made.records);
    if (tree.tiles().empty()) {
        throw Failure("no tile of a globe or a map in \"" + files.rootFile() +
                      "\"; name the root file of a paged database");
    }
    const std::vector<AnalyticBin> bins = binsWithCracks(tree.tiles());
    made.index = new BinIndex;
    const FileStamp root = files.stampOf("");
    made.index->setSource({files.rootName(), root.size, root.time});
    for (const auto& [file, record] : made.records) {
        if (!record.isRead) continue;
        const std::size_t first = record.tiles.empty() ? 0 : tree.firstOf(file);
        made.index->setTiles(file, entriesOf(record, bins.data() + first));
    }
    warn(tree.unreadFiles(), files, "files are missing or broken",
         "the tiles above are taken to reach from -11500 m to 9000 m", made);
    warn(tree.unknownTiles(), files, "tiles have surfaces whose bounds are not known",
         "they and the tiles above them are culled by what is loaded of them, as without an index", made);
    return made;
}

}  // namespace osgAnalyticBin::indexing

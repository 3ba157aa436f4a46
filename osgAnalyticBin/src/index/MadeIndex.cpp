// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::indexing {

using core::Interval;

namespace {

// For files that cannot be read now.
constexpr Interval kTerrainAltitudes = CullOptions::kTerrainOnEarth;
// The unit of a map may be the foot.
constexpr double kFeetInMetre = 1.0 / 0.3048;
constexpr Interval kTerrainInMap{kTerrainAltitudes.lower * kFeetInMetre, kTerrainAltitudes.upper* kFeetInMetre};

// A file that is part of a cycle, among those that could not be sorted.
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

// Each file after all that name it.
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

// What is drawn, skirts included.
struct Drawn {
    AnalyticBin bin;
    bool isKnown = true;     // false: something has no known surface, and `bin` is of no use
    bool lacksFile = false;  // something is missing that the tile above may draw in its place

    void add(const Drawn& other) {
        isKnown = isKnown && other.isKnown;
        if (isKnown) bin.expandBy(other.bin);
    }
};

struct Gaps {
    std::size_t count = 0;
    std::string first;

    void add(const std::string& file) {
        ++count;
        first = file;
    }
    void warn(const DatabaseFiles& files, const std::string& what, const std::string& hence, MadeIndex& made) const {
        if (count == 0) return;
        made.warnings.push_back(std::to_string(count) + ' ' + what + ", the first in \"" + files.pathOf(first) +
                                "\"; " + hence);
    }
};

// Puts together what tiles and their descendants draw, beginning with the files that page no others.
class Uniting {
public:
    explicit Uniting(MadeIndex& made) : _made(made) {
        const std::vector<const FileRecord*> order = sorted(made.records);
        for (auto record = order.rbegin(); record != order.rend(); ++record) add(**record);
    }

    Gaps unreadFiles, unknownTiles;

private:
    void add(const FileRecord& record) {
        Drawn& whole = _ofFile[record.file];  // of what is part of no tile of the file
        whole.isKnown = !record.hasOtherContent;
        whole.lacksFile = !record.isRead;
        if (!record.isRead) unreadFiles.add(record.file);
        if (record.hasOtherContent && record.place.isBelowTile) unknownTiles.add(record.file);
        std::vector<Drawn> tiles;
        for (const TileRecord& tile : record.tiles) {
            const AnalyticBin own = tile.surface.bin.withSkirts(tile.surface.skirt);
            tiles.push_back({own, own.valid()});
            if (!own.valid()) unknownTiles.add(record.file);
        }
        for (const FileLink& link : record.links) {
            const Drawn& below = _ofFile.at(link.file);
            Drawn& above = link.tile < 0 ? whole : tiles[static_cast<std::size_t>(link.tile)];
            above.lacksFile = above.lacksFile || below.lacksFile;
            above.add(below);
        }
        // tiles stand behind those that they are in
        for (std::size_t i = tiles.size(); i-- > 0;) {
            if (tiles[i].lacksFile) replaceMissing(record.tiles[i].surface, tiles[i]);
            const std::int32_t parent = record.tiles[i].parent;
            (parent < 0 ? whole : tiles[static_cast<std::size_t>(parent)]).add(tiles[i]);
        }
        if (record.isRead) setEntries(record, tiles);
    }

    static void replaceMissing(const TileSurface& surface, Drawn& tile) {
        if (!tile.isKnown) return;
        const Interval altitude = surface.isInMap ? kTerrainInMap : kTerrainAltitudes;
        tile.bin.expandBy(AnalyticBin(surface.bin.bin().withAltitude(altitude)).withSkirts(surface.skirt));
    }

    void setEntries(const FileRecord& record, const std::vector<Drawn>& tiles) {
        std::vector<BinIndex::Entry> entries;
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const TileRecord& own = record.tiles[i];
            const double ownLow = own.surface.bin.valid() ? own.surface.bin.bin().altitude().lower : 0.0;
            entries.push_back({tiles[i].isKnown ? tiles[i].bin : AnalyticBin(), ownLow, own.fingerprint});
        }
        _made.index->setTiles(record.file, std::move(entries));
    }

    MadeIndex& _made;
    std::map<std::string, Drawn> _ofFile;
};

}  // namespace

MadeIndex indexFrom(const DatabaseFiles& files, FileRecords records) {
    MadeIndex made;
    made.records = std::move(records);
    made.index = new BinIndex;
    const FileStamp root = files.stampOf("");
    made.index->setSource({files.rootName(), root.size, root.time});
    const Uniting united(made);
    if (made.index->tileCount() == 0) {
        throw Failure("no tile of a globe or a map in \"" + files.rootFile() +
                      "\"; name the root file of a paged database");
    }
    united.unreadFiles.warn(files, "files are missing or broken",
                            "the tiles above are taken to reach from -11500 m to 9000 m", made);
    united.unknownTiles.warn(files, "tiles have surfaces whose bounds are not known",
                             "they and the tiles above them are culled by what is loaded of them, as without an index",
                             made);
    return made;
}

}  // namespace osgAnalyticBin::indexing

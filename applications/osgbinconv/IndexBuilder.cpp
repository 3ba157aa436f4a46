// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexBuilder.h"

#include "CrackFloor.h"
#include "Failure.h"
#include "PartFile.h"
#include "TileTree.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::BinIndex;

namespace {

constexpr const char* kMagic = "\x89osgBins";

void warn(const TileTree::Gaps& gaps, const DatabaseFiles& files, const std::string& what, const std::string& hence) {
    if (gaps.count == 0) return;
    std::cerr << "osgbinconv: warning: " << gaps.count << ' ' << what << ", the first in \"" << files.pathOf(gaps.first)
              << "\"; " << hence << std::endl;
}

std::vector<BinIndex::Entry> entriesOf(const FileRecord& record, const AnalyticBin* bins) {
    std::vector<BinIndex::Entry> entries;
    for (const TileRecord& tile : record.tiles) {
        const double ownLow = tile.surface.bin.valid() ? tile.surface.bin.bin().altitude().lower : 0.0;
        entries.push_back({*bins++, ownLow, tile.fingerprint});
    }
    return entries;
}

/// The lowest surface, where all of it is known and nothing of the globe is without.
std::optional<double> horizonOf(const std::vector<TreeTile>& tiles) {
    double lowest = HUGE_VAL;
    for (const TreeTile& tile : tiles) {
        if (tile.depth > 0) continue;
        if (!tile.isKnown) return std::nullopt;
        lowest = std::min(lowest, tile.united.bin().altitude().lower - tile.united.margin());
    }
    if (!coversTheGlobe(tiles)) return std::nullopt;
    return lowest;
}

/// The index is going to be replaced: it must be one.
void requireNothingForeign(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return;
    std::string magic(8, '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    if (in && magic != kMagic) throw Failure("\"" + path + "\" is no index of bins; move it away");
}

}  // namespace

BuiltIndex indexFrom(const DatabaseFiles& files, FileRecords records) {
    BuiltIndex built;
    built.records = std::move(records);
    const TileTree tree(built.records);
    if (tree.tiles().empty()) {
        throw Failure("no tile of a globe or a map in \"" + files.rootFile() +
                      "\"; name the root file of a paged database");
    }
    const std::vector<AnalyticBin> bins = binsWithCracks(tree.tiles());
    built.index = new BinIndex;
    const FileStamp root = files.stampOf("");
    built.index->setSource({files.rootName(), root.size, root.time});
    for (const auto& [file, record] : built.records) {
        if (!record.isRead) continue;
        const std::size_t first = record.tiles.empty() ? 0 : tree.firstOf(file);
        built.index->setTiles(file, entriesOf(record, bins.data() + first));
    }
    built.horizon = horizonOf(tree.tiles());
    warn(tree.unreadFiles(), files, "files are missing or broken",
         "the tiles above are taken to reach from -11500 m to 9000 m");
    warn(tree.unknownTiles(), files, "tiles have surfaces whose bounds are not known",
         "they and the tiles above them are never culled");
    return built;
}

namespace {

/// A database of which no index can be made leaves no records behind.
BuiltIndex builtWith(PartFile& part, const DatabaseFiles& files, const WalkOptions& options) {
    const auto keep = [&part](const FileRecord& record) { part.append(record); };
    try {
        return indexFrom(files, walkDatabase(files, part.takeRecords(), keep, options));
    } catch (const Failure&) {
        if (!part.hasFailed()) part.remove();
        throw;
    }
}

}  // namespace

void writeIndex(const DatabaseFiles& files, const WalkOptions& options, bool keepsRecords) {
    const std::string name = osgAnalyticBin::binIndexName(files.rootFile());
    requireNothingForeign(name);
    PartFile part(name + ".part");
    const BuiltIndex built = builtWith(part, files, options);
    std::string error;
    if (!built.index->write(name, error)) throw Failure(error);
    if (keepsRecords) {
        part.keepOnly(built.records);
    } else {
        part.remove();
    }
}

}  // namespace osgbinconv

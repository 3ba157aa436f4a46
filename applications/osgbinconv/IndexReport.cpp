// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"

#include <osgAnalyticBin/BinIndex.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

using osgAnalyticBin::BinIndex;

namespace {

using Entry = BinIndex::Entry;
using osgAnalyticBin::core::Interval;

struct Statistics {
    std::size_t tiles = 0;
    std::size_t unknown = 0;
    Interval altitudes = Interval::none();
    Interval finest = Interval::none();                          // altitudes in the finest tiles
    double narrowest = std::numeric_limits<double>::infinity();  // radians of longitude, or of a map's x

    void add(const Entry& entry) {
        ++tiles;
        if (!entry.bin.valid()) {
            ++unknown;
            return;
        }
        const osgAnalyticBin::core::GeodeticBin& bin = entry.bin.bin();
        altitudes = altitudes.united(bin.altitude());
        const double width = bin.longitude().width();
        constexpr double kMuchNarrower = 0.75;
        if (width < kMuchNarrower * narrowest) finest = Interval::none();
        narrowest = std::min(narrowest, width);
        if (kMuchNarrower * width < narrowest) finest = finest.united({entry.ownLow, bin.altitude().upper});
    }
};

bool isSame(const Entry& a, const Entry& b) {
    const bool isSameBin = a.bin.valid() ? a.bin == b.bin : !b.bin.valid();
    return isSameBin && a.ownLow == b.ownLow && a.fingerprint == b.fingerprint;
}

/// How many entries of `expected` the other index has not, or has otherwise; the first of these files.
struct Differences {
    std::size_t count = 0;
    std::string firstFile;

    void compare(const BinIndex& expected, const BinIndex& found) {
        for (const auto& [file, tiles] : expected.files()) {
            const std::vector<Entry>* others = found.tilesOf(file);
            std::size_t differing = others ? 0 : std::max<std::size_t>(tiles.size(), 1);
            for (std::size_t i = 0; others && i < tiles.size(); ++i)
                if (i >= others->size() || !isSame(tiles[i], (*others)[i])) ++differing;
            if (differing > 0 && count == 0) firstFile = file;
            count += differing;
        }
    }
};

std::string noIndexOf(const std::string& database) {
    return "\"" + database + "\" has no index; make one with osgbinconv --index";
}

}  // namespace

void printIndex(const std::string& file) {
    const std::string beside = osgAnalyticBin::binIndexName(file);
    const std::string path = std::filesystem::exists(beside) ? beside : file;
    std::string error;
    const osg::ref_ptr<BinIndex> index = BinIndex::read(path, error);
    const bool isDatabase = std::filesystem::exists(file) && std::filesystem::path(file).extension() != ".bins";
    if (!index && path == file && isDatabase) throw Failure(noIndexOf(file));
    if (!index) throw Failure(error);
    Statistics all;
    for (const auto& [name, tiles] : index->files())
        for (const Entry& entry : tiles) all.add(entry);
    const auto bytes = std::filesystem::file_size(path);
    std::printf("database     %s, %llu bytes\n", index->source().name.c_str(),
                static_cast<unsigned long long>(index->source().size));
    std::printf("tiles        %zu in %zu files\n", all.tiles, index->fileCount());
    std::printf("without bounds %zu\n", all.unknown);
    if (all.unknown < all.tiles) {
        std::printf("heights      %.0f .. %.0f m in the finest tiles\n", all.finest.lower, all.finest.upper);
        std::printf("bins         %.0f .. %.0f m: coarse tiles are flat, and sag below the ground\n",
                    all.altitudes.lower, all.altitudes.upper);
    }
    std::printf("size         %llu bytes, %.1f per tile\n", static_cast<unsigned long long>(bytes),
                static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(all.tiles, 1)));
}

void checkIndex(const DatabaseFiles& files, const WalkOptions& options) {
    const std::string name = osgAnalyticBin::binIndexName(files.rootFile());
    if (!std::filesystem::exists(name)) throw Failure(noIndexOf(files.rootFile()));
    std::string error;
    const osg::ref_ptr<BinIndex> found = BinIndex::read(name, error);
    if (!found) throw Failure(error);
    const MadeIndex built = buildIndex(files, options);
    Differences differences;
    differences.compare(*built.index, *found);
    differences.compare(*found, *built.index);
    if (differences.count > 0)
        throw Failure("\"" + name + "\" does not agree with its database, first in \"" +
                      files.pathOf(differences.firstFile) + "\"; make it again with osgbinconv --index");
    std::printf("%s agrees with its database: %zu tiles in %zu files\n", name.c_str(), found->tileCount(),
                found->fileCount());
}

}  // namespace osgbinconv

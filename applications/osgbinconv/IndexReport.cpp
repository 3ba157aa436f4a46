// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"

#include <osgAnalyticBin/BinIndex.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace osgbinconv {

using osgAnalyticBin::support::Failure;

using osgAnalyticBin::BinIndex;

namespace {

using Entry = BinIndex::Entry;

struct Statistics {
    std::size_t tiles = 0;
    std::size_t unknown = 0;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    double narrowestDeg = HUGE_VAL;
    double widestDeg = 0.0;

    void add(const Entry& entry) {
        constexpr double kDegreesPerRadian = 57.29577951308232087680;
        ++tiles;
        if (!entry.bin.valid()) {
            ++unknown;
            return;
        }
        const osgAnalyticBin::core::GeodeticBin& bin = entry.bin.bin();
        low = std::min(low, bin.altitude().lower);
        high = std::max(high, bin.altitude().upper);
        narrowestDeg = std::min(narrowestDeg, bin.longitude().width() * kDegreesPerRadian);
        widestDeg = std::max(widestDeg, bin.longitude().width() * kDegreesPerRadian);
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
        expected.forEachFile([&](const std::string& file, const std::vector<Entry>& tiles) {
            const std::vector<Entry>* others = found.tilesOf(file);
            std::size_t differing = others ? 0 : std::max<std::size_t>(tiles.size(), 1);
            for (std::size_t i = 0; others && i < tiles.size(); ++i) {
                if (i >= others->size() || !isSame(tiles[i], (*others)[i])) ++differing;
            }
            if (differing > 0 && count == 0) firstFile = file;
            count += differing;
        });
    }
};

}  // namespace

void printIndex(const std::string& path) {
    std::string error;
    const osg::ref_ptr<BinIndex> index = BinIndex::read(path, error);
    if (!index) throw Failure(error);
    Statistics all;
    index->forEachFile([&all](const std::string&, const std::vector<Entry>& tiles) {
        for (const Entry& entry : tiles) all.add(entry);
    });
    const auto bytes = std::filesystem::file_size(path);
    std::printf("database     %s, %llu bytes\n", index->source().name.c_str(),
                static_cast<unsigned long long>(index->source().size));
    std::printf("tiles        %zu in %zu files\n", all.tiles, index->fileCount());
    std::printf("never culled %zu\n", all.unknown);
    if (all.unknown < all.tiles) {
        std::printf("altitudes    %.0f .. %.0f m\n", all.low, all.high);
        // of a quadtree, whose tiles halve from level to level
        const double levels = std::round(std::log2(all.widestDeg / all.narrowestDeg)) + 1.0;
        std::printf("widths       %.6g .. %.6g degrees of longitude, some %.0f levels\n", all.narrowestDeg,
                    all.widestDeg, levels);
    }
    std::printf("size         %llu bytes, %.1f per tile\n", static_cast<unsigned long long>(bytes),
                static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(all.tiles, 1)));
}

void checkIndex(const DatabaseFiles& files, const WalkOptions& options) {
    const std::string name = osgAnalyticBin::binIndexName(files.rootFile());
    std::string error;
    const osg::ref_ptr<BinIndex> found = BinIndex::read(name, error);
    if (!found) throw Failure(error);
    const MadeIndex built = buildIndex(files, options);
    Differences differences;
    differences.compare(*built.index, *found);
    differences.compare(*found, *built.index);
    if (differences.count > 0) {
        throw Failure("\"" + name + "\" does not agree with its database, first in \"" +
                      files.pathOf(differences.firstFile) + "\"; make it again with osgbinconv --index");
    }
    std::printf("%s agrees with its database: %zu tiles in %zu files\n", name.c_str(), found->tileCount(),
                found->fileCount());
}

}  // namespace osgbinconv

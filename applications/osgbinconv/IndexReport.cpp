// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Commands.h"
#include "Failure.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

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
    Interval finest = Interval::none();  // altitudes in the finest tiles
    Interval widths = Interval::none();  // radians of longitude, or of a map's x

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
        if (width < kMuchNarrower * widths.lower) finest = Interval::none();
        widths.expandBy(width);
        if (kMuchNarrower * width < widths.lower) finest = finest.united({entry.ownLow, bin.altitude().upper});
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

// Whether the database beside an index is a map, which the index does not tell. Returns: nullopt where its root file
// has no tiles, or cannot be read.
std::optional<bool> isOfMap(const std::string& indexFile, const BinIndex& index) {
    const auto root = std::filesystem::path(indexFile).parent_path() / index.source().name;
    if (!std::filesystem::is_regular_file(root)) return std::nullopt;
    const osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(root.string());
    if (!database) return std::nullopt;
    const auto tiles = osgAnalyticBin::findTiles(*database);
    if (tiles.empty() || !tiles.front().frame.ellipsoid) return std::nullopt;
    return osgAnalyticBin::isMapPlane(*tiles.front().frame.ellipsoid);
}

std::string noIndexOf(const std::string& database) {
    return "\"" + database + "\" has no index; make one with osgbinconv --index";
}

void printWidths(const Statistics& all, bool isMap) {
    constexpr double kDegreesPerRadian = 57.29577951308232087680;
    const double unit = isMap ? osgAnalyticBin::core::Ellipsoid::kMapUnitsInRadian : kDegreesPerRadian;
    // of a quadtree, whose tiles halve from level to level
    const double levels = std::round(std::log2(all.widths.upper / all.widths.lower)) + 1.0;
    std::printf("widths       %.6g .. %.6g %s, some %.0f levels\n", all.widths.lower * unit, all.widths.upper * unit,
                isMap ? "m in a map" : "degrees of longitude", levels);
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
        if (const std::optional<bool> isMap = isOfMap(path, *index))
            printWidths(all, *isMap);
        else
            std::printf("widths       unknown without \"%s\" beside the index\n", index->source().name.c_str());
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

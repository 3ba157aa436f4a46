// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// Where the content of a file stands, as far as the file that names it says.
struct FilePlace {
    /// Metres; 0: not below a geocentric CoordinateSystemNode.
    double equatorialRadius = 0.0;
    double polarRadius = 0.0;
    /// As of osgAnalyticBin::TileFrame.
    bool isProjected = false;
    std::array<double, 16> localToEcef{};
    bool isBelowTile = false;
    /// osgTerrain::Terrain's.
    double sampleRatio = 1.0;

    /// Whether all is the same.
    [[nodiscard]] bool operator==(const FilePlace& other) const {
        return equatorialRadius == other.equatorialRadius && polarRadius == other.polarRadius &&
               isProjected == other.isProjected && localToEcef == other.localToEcef &&
               isBelowTile == other.isBelowTile && sampleRatio == other.sampleRatio;
    }
};

/// The frame of a file's content.
[[nodiscard]] OSGANALYTICBIN_EXPORT TileFrame frameOf(const FilePlace& place, const std::string& file);

/// A file that is paged below another one.
struct FileLink {
    /// Path relative to the root file's folder.
    std::string file;
    /// Ordinal of the tile that it is paged below, in the file that names it; -1: none.
    std::int32_t tile = -1;
    FilePlace place;
};

struct TileRecord {
    osgAnalyticBin::TileSurface surface;
    std::uint64_t fingerprint = 0;
    /// Ordinal of the tile in the same file that it stands below; -1: none.
    std::int32_t parent = -1;
};

/// Whether a file is still the one that was read.
using FileStamp = BinIndex::Stamp;

/// All that is kept of a file once it has been read.
struct FileRecord {
    /// Path relative to the root file's folder; "" for the root file.
    std::string file;
    FileStamp stamp;
    /// Where it was read.
    FilePlace place;
    /// False for a file that is missing or cannot be read.
    bool isRead = false;
    /// Whether the file draws anything that is part of no tile.
    bool hasOtherContent = false;
    std::vector<TileRecord> tiles;
    std::vector<FileLink> links;
};

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/TileSurface.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// The coordinate frame of a file's content, as the file that names it gives it.
struct FilePlace {
    /// Metres; 0: not below a geocentric CoordinateSystemNode.
    double equatorialRadius = 0.0;
    /// Metres.
    double polarRadius = 0.0;
    /// TileFrame::isProjected.
    bool isProjected = false;
    /// The matrix from the content's frame to ECEF, row by row.
    std::array<double, 16> localToEcef{};
    /// TileFrame::isBelowTile.
    bool isBelowTile = false;
    /// osgTerrain::Terrain::getSampleRatio().
    double sampleRatio = 1.0;

    /// Whether all members are equal.
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
    /// The frame of its content.
    FilePlace place;
};

/// The record of a tile.
struct TileRecord {
    /// What the tile draws by itself.
    osgAnalyticBin::TileSurface surface;
    /// tileFingerprint() of the tile.
    std::uint64_t fingerprint = 0;
    /// Ordinal of the tile in the same file that it stands below; -1: none.
    std::int32_t parent = -1;
};

/// Whether a file is still the one that was read.
using FileStamp = BinIndex::Stamp;

/// The record of a file that has been read.
struct FileRecord {
    /// Path relative to the root file's folder; "" for the root file.
    std::string file;
    /// Size and time of the file when it was read.
    FileStamp stamp;
    /// The frame in which it was read.
    FilePlace place;
    /// False for a file that is missing or cannot be read.
    bool isRead = false;
    /// Whether the file draws anything that is part of no tile.
    bool hasOtherContent = false;
    /// In preorder. Of a photogrammetry set: its LODs, with the boxes of the vertices below each and below no other.
    std::vector<TileRecord> tiles;
    /// Of a photogrammetry set: the vertices below no LOD.
    osgAnalyticBin::TileSurface beside;
    /// Files that it pages.
    std::vector<FileLink> links;
};

}  // namespace osgAnalyticBin::indexing

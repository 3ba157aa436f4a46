// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <string>
#include <vector>

namespace osgAnalyticBin::indexing {

/// An index with the records that it was made from.
struct MadeIndex {
    /// The bins of all tiles.
    osg::ref_ptr<BinIndex> index;
    /// Of all files of the database.
    FileRecords records;
    /// Missing files and tiles without a bin, a line each.
    std::vector<std::string> warnings;
};

/// The index of the bins in the records of all files. Throws Failure when there is no tile, or when a file is paged
/// below itself.
[[nodiscard]] OSGANALYTICBIN_EXPORT MadeIndex indexFrom(const DatabaseFiles& files, FileRecords records);

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFiles.h"
#include "DatabaseWalk.h"

#include <osgAnalyticBin/BinIndex.h>

#include <optional>

namespace osgbinconv {

/// An index, and what it took to make it.
struct BuiltIndex {
    osg::ref_ptr<osgAnalyticBin::BinIndex> index;
    FileRecords records;
    /// Where the tiles cover the whole globe: the altitude in metres that no surface goes below.
    std::optional<double> horizon;
};

/// The index of the bins in the records; tells on stderr, in a line each, what is missing or unknown.
/// Throws Failure when there is no tile, or when a file is paged below itself.
[[nodiscard]] BuiltIndex indexFrom(const DatabaseFiles& files, FileRecords records);

/// Writes "earth.ive.bins" beside a database. Finished files are kept in "earth.ive.bins.part", from which a second run
/// goes on; the result does not depend on it. `keepsRecords`: it stays, so that the next run reads only the files that
/// have changed. Throws Failure or Interrupted.
void writeIndex(const DatabaseFiles& files, const WalkOptions& options, bool keepsRecords);

}  // namespace osgbinconv

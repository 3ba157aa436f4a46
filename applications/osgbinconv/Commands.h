// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <functional>
#include <string>
#include <vector>

namespace osgbinconv {

using osgAnalyticBin::indexing::DatabaseFiles;
using osgAnalyticBin::indexing::FileRecord;
using osgAnalyticBin::indexing::FileRecords;
using osgAnalyticBin::indexing::MadeIndex;

struct WalkOptions {
    int threads = 1;
    bool isQuiet = false;
};

/// Reads a database, with progress on stderr, and makes its index; tells on stderr, in a line each, what is missing or
/// unknown. `known`: records of an earlier run; `keep` gets each new one, never two at a time.
/// Throws what walkDatabase() and indexFrom() throw; Interrupted when the user stops the program.
[[nodiscard]] MadeIndex buildIndex(const DatabaseFiles& files, const WalkOptions& options,
                                   std::vector<FileRecord> known = {},
                                   const std::function<void(const FileRecord&)>& keep = {});

/// Writes "earth.ive.bins" beside a database. Finished files are kept in "earth.ive.bins.part", from which a second run
/// goes on; the result does not depend on it. `keepsRecords`: it stays, so that the next run reads only the files that
/// have changed. Throws Failure or Interrupted.
void writeIndex(const DatabaseFiles& files, const WalkOptions& options, bool keepsRecords);

/// Prints what is in an index, or in that of a database, in a few lines. Throws Failure when it cannot be read.
void printIndex(const std::string& file);

/// Makes the index of a database anew, in memory, and compares the one beside it. Says in a line that they agree.
/// Throws Failure where they do not.
void checkIndex(const DatabaseFiles& files, const WalkOptions& options);

}  // namespace osgbinconv

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFiles.h"
#include "FileRecord.h"

#include <functional>
#include <map>
#include <string>

namespace osgbinconv {

struct WalkOptions {
    int threads = 1;
    bool isQuiet = false;
    Images images = Images::Left;
};

/// The records of a database's files, by their names.
using FileRecords = std::map<std::string, FileRecord>;

/// Reads every file of a database once, each in one of several threads, and forgets its scene at once. `known` are
/// records of an earlier run, taken where the file has not changed; `keep` gets each new record, never two at a time.
/// Shows progress on stderr. The result does not depend on the threads.
/// Throws Failure when the root file cannot be read, or when a file is named that is outside of the folder or stands in
/// two frames; Interrupted when the user stops the program.
[[nodiscard]] FileRecords walkDatabase(const DatabaseFiles& files, std::vector<FileRecord> known,
                                       const std::function<void(const FileRecord&)>& keep, const WalkOptions& options);

}  // namespace osgbinconv

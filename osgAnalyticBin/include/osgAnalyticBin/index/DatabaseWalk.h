// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <map>
#include <string>
#include <vector>

/// Reads all files of a database and finds the bins of its tiles.
namespace osgAnalyticBin::indexing {

/// The records of a database's files, by their names.
using FileRecords = std::map<std::string, FileRecord>;

/// Observes a walk over the files of a database. An exception from one of its functions ends the walk.
class OSGANALYTICBIN_EXPORT WalkObserver {
public:
    virtual ~WalkObserver();
    /// Before a file is read, in the thread that will read it. May be called by several threads at once.
    virtual void beforeFile() {}
    /// A file is done. Never two calls at a time. `isKnown`: its record is from an earlier walk. `share`: the part
    /// of the whole walk that is done with this file; the sum of all shares is 1.
    virtual void done(const FileRecord& record, bool isKnown, double share);
};

/// Reads every file of a database once, in several threads, and keeps a record of it, not its scene. The walk is depth
/// first: the files paged below a file follow soon after it. `known`: records of an earlier walk, used for files that
/// have not changed. The result does not depend on the number of threads. With one, files are read in the caller's.
/// Throws Failure when the root file cannot be read, when a file outside of the folder is paged, or when a file is
/// paged in two frames that differ; and what the observer throws.
[[nodiscard]] OSGANALYTICBIN_EXPORT FileRecords walkDatabase(const DatabaseFiles& files, std::vector<FileRecord> known,
                                                             WalkObserver& observer, int threads);

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

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Commands.h"
#include "DiskFile.h"

#include <map>
#include <string>
#include <vector>

namespace osgbinconv {

/// The records of an index that is being made, "earth.ive.bins.part": appended one by one, each with its checksum, so
/// that a run that was killed goes on where it ended, or a later one reads only what has changed. Each record says of
/// which file it is; whether that has changed is the reader's to see. Locked against a second program.
class PartFile final {
public:
    /// Opens the file and takes what is whole in it. Throws Failure.
    explicit PartFile(const std::string& path);

    /// What an earlier run has left; to be called once.
    [[nodiscard]] std::vector<FileRecord> takeRecords() { return std::move(_records); }

    /// Not to be called by two threads at once. Throws Failure.
    void append(const FileRecord& record);

    /// Deletes the file: nobody needs it any more.
    void remove();

    /// Has just these records from here on. Throws Failure.
    void keepOnly(const std::map<std::string, FileRecord>& records);

    /// Whether the records could not be written, for want of room.
    [[nodiscard]] bool hasFailed() const { return _hasFailed; }

private:
    void load();
    void clear();
    void write(const std::string& bytes);
    [[noreturn]] void fail();

    std::string _path;
    const osgAnalyticBin::support::LockedFile _lock;
    bool _hasFailed = false;
    std::vector<FileRecord> _records;
};

}  // namespace osgbinconv

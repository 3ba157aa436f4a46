// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FileRecord.h"

#include <string>
#include <vector>

namespace osgbinconv {

/// The records of an index that is being made, "earth.ive.bins.part": appended one by one, each with its checksum, so
/// that a run that was killed goes on where it ended. Locked against a second program.
class PartFile final {
public:
    /// Opens the file and takes what is whole in it; a file of another database is started afresh. Throws Failure.
    PartFile(const std::string& path, const FileStamp& rootStamp);
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile();

    /// What an earlier run has left; to be called once.
    [[nodiscard]] std::vector<FileRecord> takeRecords() { return std::move(_records); }

    /// Not to be called by two threads at once. Throws Failure.
    void append(const FileRecord& record);

    /// Deletes the file: nobody needs it any more.
    void remove();

    /// Whether the records could not be written, for want of room.
    [[nodiscard]] bool hasFailed() const { return _hasFailed; }

private:
    void load(const std::string& head);
    void write(const std::string& bytes);
    [[noreturn]] void fail(const std::string& what);

    std::string _path;
    int _handle = -1;
    bool _hasFailed = false;
    std::vector<FileRecord> _records;
};

}  // namespace osgbinconv

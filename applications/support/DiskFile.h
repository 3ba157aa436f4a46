// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::support {

/// A file that is open for reading and writing, made if it is missing, and locked against other programs.
class LockedFile final {
public:
    /// `program` and `output`: for messages. `flags`: as open() takes them, more than
    /// needed. Throws: Failure.
    LockedFile(std::string path, const std::string& program, const std::string& output, int flags = 0);
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;
    ~LockedFile();

    [[nodiscard]] int handle() const noexcept { return _handle; }
    /// Deletes the file; it stays locked.
    void remove() const;

private:
    std::string _path;
    int _handle;
};

/// Waits until everything in the file system of a folder is on the disk, as far as this machine has written it.
/// Throws Failure.
void flushToDisk(const std::string& folder);

}  // namespace osgAnalyticBin::support

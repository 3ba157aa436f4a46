// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace osgAnalyticBin::support {

/// Writes a file under another name and renames it, so that it is either complete or as it was before, and notices a
/// full disk. `write`: whether the stream took everything. Throws: Failure.
void writeFile(const std::string& file, const std::string& text);
void writeFile(const std::string& file, const std::function<bool(std::ostream&)>& write);

/// The bytes of a file; empty where it cannot be read.
[[nodiscard]] std::string contentOf(const std::string& file);

/// For what would only be found out at the end of a long run. Throws: Failure when the folder of a file, which an
/// option names, is not there; an empty name is none.
void requireFolderOf(const char* option, const std::string& file);

/// Makes a folder, and those above it, unless it is there. Throws: Failure.
void makeFolder(const std::string& folder);

/// A file that is open for reading and writing, made if it is missing, and locked against other programs.
class LockedFile final {
public:
    /// `program` and `output`: for messages. `flags`: more of open()'s. Throws: Failure.
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

/// The value with so many decimals.
[[nodiscard]] std::string withDecimals(double value, int decimals);

}  // namespace osgAnalyticBin::support

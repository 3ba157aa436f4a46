// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "TextFile.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace osgAnalyticBin::support {

namespace {

bool lock(int handle, const std::string& path) {
    struct stat held {};
    struct stat named {};
    if (::flock(handle, LOCK_EX | LOCK_NB) != 0) return false;
    // Who had it may have deleted it between opening and locking.
    return ::fstat(handle, &held) == 0 && ::stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
           held.st_dev == named.st_dev;
}

}  // namespace

LockedFile::LockedFile(std::string path, const std::string& program, const std::string& output, int flags)
    : _path(std::move(path)), _handle(::open(_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | flags, 0666)) {
    if (_handle < 0)
        throw Failure("cannot write \"" + output + "\": " + std::strerror(errno) + "; choose another folder");
    if (lock(_handle, _path)) return;
    ::close(_handle);
    throw Failure("another " + program + " is writing \"" + output + "\"; wait for it or choose another name");
}

LockedFile::~LockedFile() {
    ::close(_handle);
}

void LockedFile::remove() const {
    ::unlink(_path.c_str());
}

void flushToDisk(const std::string& folder) {
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool isFlushed = handle >= 0 && ::syncfs(handle) == 0;
    const int error = errno;
    if (handle >= 0) ::close(handle);
    if (!isFlushed) throw Failure("cannot write \"" + folder + "\": " + std::strerror(error) + "; check the disk");
}

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexStore.h"

#if defined(_WIN32)
#include "../WholeFile.h"
#endif

#include <boost/crc.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#if defined(_WIN32)
#include <io.h>
#include <share.h>
#else
#include <sys/file.h>
#include <unistd.h>
#endif

namespace osgAnalyticBin::indexing {

namespace {

namespace fs = std::filesystem;

#if defined(_WIN32)

// A file that one process at a time can open. Windows deletes it when it is closed, also where the process ends.
class LockFile {
public:
    explicit LockFile(const std::string& path)
        : _handle(::_sopen(path.c_str(), _O_RDWR | _O_CREAT | _O_TEMPORARY, _SH_DENYRW, _S_IREAD | _S_IWRITE)) {
        if (_handle >= 0) return;
        error = std::strerror(errno);
        std::error_code ignored;
        isBusy = fs::exists(path, ignored);
    }
    ~LockFile() {
        if (_handle >= 0) ::_close(_handle);
    }
    LockFile(const LockFile&) = delete;
    LockFile& operator=(const LockFile&) = delete;

    bool isBusy = false;
    std::string error;

private:
    const int _handle;
};

bool keepAlone(const IndexFile& index, const std::string& path, std::string& error) {
    const LockFile lock(path + ".making");
    if (lock.isBusy) return true;
    if (lock.error.empty()) return writeWholeFile(path, index.write, error);
    error = "cannot write \"" + path + "\": " + lock.error;
    return false;
}

#else

// A temporary file that one process at a time may write. It is removed unless it becomes the file.
class LockedFile {
public:
    explicit LockedFile(const std::string& path) : _path(path + ".making") {
        _handle = ::open(_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (_handle < 0) {
            error = std::strerror(errno);
            return;
        }
        struct stat own {
        }, named{};
        const bool isLocked = ::flock(_handle, LOCK_EX | LOCK_NB) == 0;
        // another process may have renamed it meanwhile
        const bool isNamed = isLocked && ::fstat(_handle, &own) == 0 && ::stat(_path.c_str(), &named) == 0 &&
                             own.st_ino == named.st_ino && own.st_dev == named.st_dev;
        if (isNamed) return;
        isBusy = true;
        ::close(_handle);
        _handle = -1;
    }
    ~LockedFile() {
        if (_handle < 0) return;
        if (!_isRenamed) ::unlink(_path.c_str());
        ::close(_handle);
    }
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;

    [[nodiscard]] bool become(const IndexFile& index, const std::string& path) {
        std::ofstream out(_path, std::ios::binary | std::ios::trunc);
        errno = 0;
        const bool isWritten = out && index.write(out) && out.flush();
        out.close();
        _isRenamed = isWritten && out && std::rename(_path.c_str(), path.c_str()) == 0;
        if (!_isRenamed) error = errno != 0 ? std::strerror(errno) : "the disk may be full";
        return _isRenamed;
    }
    [[nodiscard]] bool isOpen() const { return _handle >= 0; }

    bool isBusy = false;
    std::string error;

private:
    const std::string _path;
    int _handle = -1;
    bool _isRenamed = false;
};

bool keepAlone(const IndexFile& index, const std::string& path, std::string& error) {
    LockedFile file(path);
    if (file.isBusy) return true;
    if (file.isOpen() && file.become(index, path)) return true;
    error = "cannot write \"" + path + "\": " + file.error;
    return false;
}

#endif

// Whether a file may be replaced: there is none, or it is such an index, whole or broken at its end.
bool isOurs(const std::string& path, std::string_view kind) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        std::error_code ignored;
        return !fs::exists(path, ignored);
    }
    std::string magic(kind.size(), '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    return in.gcount() == 0 || magic == kind;
}

bool keepAt(const IndexFile& index, const std::string& path, std::string& error) {
    if (!isOurs(path, index.magic)) {
        error = "\"" + path + "\" is no index";
        return false;
    }
    return keepAlone(index, path, error);
}

std::string cacheFolder() {
#if defined(_WIN32)
    const char* const local = std::getenv("LOCALAPPDATA");
    return local && *local ? std::string(local) + "/osgAnalyticBin" : std::string();
#else
    const char* const xdg = std::getenv("XDG_CACHE_HOME");
    if (xdg && *xdg == '/') return std::string(xdg) + "/osgAnalyticBin";
    const char* const home = std::getenv("HOME");
    if (home && *home == '/') return std::string(home) + "/.cache/osgAnalyticBin";
    return {};
#endif
}

}  // namespace

bool areCurrent(const BinIndex::Stamps& stamps, const DatabaseFiles& files, const std::function<void()>& checkpoint) {
    for (const auto& [file, stamp] : stamps) {
        checkpoint();
        if (!(files.stampOf(file) == stamp)) return false;
    }
    return true;
}

std::string cachedIndexName(const std::string& rootFile, const std::string& extension) {
    const std::string folder = cacheFolder();
    std::error_code failure;
    const std::string path = fs::canonical(rootFile, failure).string();
    if (folder.empty() || failure) return {};
    boost::crc_optimal<64, 0x42F0E1EBA9EA3693u, 0xFFFFFFFFFFFFFFFFu, 0xFFFFFFFFFFFFFFFFu, true, true> crc;
    crc.process_bytes(path.data(), path.size());
    char name[32];
    std::snprintf(name, sizeof name, "/%016llx.", static_cast<unsigned long long>(crc.checksum()));
    return folder + name + extension;
}

std::string keepIndex(const IndexFile& index, const std::string& rootFile, std::string& error) {
    if (keepAt(index, index.beside, error)) return index.beside;
    const std::string cached = cachedIndexName(rootFile, fs::path(index.beside).extension().string().substr(1));
    if (cached.empty()) return {};
    std::error_code failure;
    fs::create_directories(fs::path(cached).parent_path(), failure);
    return keepAt(index, cached, error) ? cached : std::string();
}

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexStore.h"

#include "Checksum.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>

namespace osgAnalyticBin::indexing {

namespace {

namespace fs = std::filesystem;

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

std::string cachedIndexName(const std::string& rootFile) {
    const std::string folder = cacheFolder();
    std::error_code failure;
    const std::string path = fs::canonical(rootFile, failure).string();
    if (folder.empty() || failure) return {};
    char name[32];
    std::snprintf(name, sizeof name, "/%016llx", static_cast<unsigned long long>(crc64(path)));
    return binIndexName(folder + name);
}

std::string keepIndex(const BinIndex& index, const std::string& rootFile, std::string& error) {
    const std::string path = cachedIndexName(rootFile);
    if (path.empty()) {
        error = "there is no cache folder";
        return {};
    }
    std::error_code failure;
    fs::create_directories(fs::path(path).parent_path(), failure);
    // others may be keeping the same index
    std::random_device random;
    const std::string own = path + "." + std::to_string(random());
    if (!index.write(own, error)) return {};
    fs::rename(own, path, failure);
    if (!failure) return path;
    error = "cannot write \"" + path + "\": " + failure.message();
    fs::remove(own, failure);
    return {};
}

}  // namespace osgAnalyticBin::indexing

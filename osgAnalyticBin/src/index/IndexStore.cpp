// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexStore.h"

#include "Checksum.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace osgAnalyticBin::indexing {

namespace {

namespace fs = std::filesystem;

// Whether a file may be replaced: there is none, or it is such an index, whole or broken at its end.
bool isOurs(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        std::error_code ignored;
        return !fs::exists(path, ignored);
    }
    std::string magic(BinIndex::kMagic.size(), '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    return in.gcount() == 0 || magic == BinIndex::kMagic;
}

bool keepAt(const BinIndex& index, const std::string& path, std::string& error) {
    if (!isOurs(path)) {
        error = "\"" + path + "\" is no index";
        return false;
    }
    // others may be keeping the same index
    std::random_device random;
    const std::string own = path + "." + std::to_string(random());
    if (!index.write(own, error)) return false;
    std::error_code failure;
    fs::rename(own, path, failure);
    if (!failure) return true;
    error = "cannot write \"" + path + "\": " + failure.message();
    fs::remove(own, failure);
    return false;
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
    const std::string beside = binIndexName(rootFile);
    if (keepAt(index, beside, error)) return beside;
    const std::string cached = cachedIndexName(rootFile);
    if (cached.empty()) return {};
    std::error_code failure;
    fs::create_directories(fs::path(cached).parent_path(), failure);
    return keepAt(index, cached, error) ? cached : std::string();
}

}  // namespace osgAnalyticBin::indexing

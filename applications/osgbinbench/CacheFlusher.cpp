// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CacheFlusher.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <unistd.h>

namespace osgAnalyticBin::bench {

namespace {

constexpr int kLeastMebibytes = 64;
constexpr std::size_t kMebibyte = 1024 * 1024;

// In virtual machines sysconf() counts the caches of processors that this machine does not have; the kernel knows.
long lastLevelKibibytes() {
    long kibibytes = 0;
    for (int level = 0; level < 8; ++level) {
        std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(level) + "/size");
        long size = 0;
        if (file >> size) kibibytes = std::max(kibibytes, size);
    }
    return kibibytes > 0 ? kibibytes : sysconf(_SC_LEVEL3_CACHE_SIZE) / 1024;
}

}  // namespace

CacheFlusher::CacheFlusher(int mebibytes) : _buffer(static_cast<std::size_t>(mebibytes) * kMebibyte) {}

void CacheFlusher::flush() {
    for (std::size_t i = 0; i < _buffer.size(); i += kCacheLine) ++_buffer[i];
}

int CacheFlusher::defaultMebibytes() {
    return std::max(kLeastMebibytes, static_cast<int>(2 * lastLevelKibibytes() / 1024));
}

}  // namespace osgAnalyticBin::bench

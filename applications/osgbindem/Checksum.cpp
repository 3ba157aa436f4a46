// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Checksum.h"

#include <cstring>

namespace osgbindem {

namespace {

constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15U;

std::uint64_t mixed(std::uint64_t sum, std::uint64_t word) noexcept {
    sum = (sum ^ word) * kFactor;
    return sum ^ (sum >> 32);
}

}  // namespace

std::uint64_t checksumOf(std::string_view bytes, std::uint64_t seed) noexcept {
    std::uint64_t sum = mixed(seed, bytes.size());
    std::uint64_t word = 0;
    while (bytes.size() >= sizeof word) {
        std::memcpy(&word, bytes.data(), sizeof word);
        sum = mixed(sum, word);
        bytes.remove_prefix(sizeof word);
    }
    word = 0;
    std::memcpy(&word, bytes.data(), bytes.size());
    return mixed(sum, word);
}

void FileSum::add(const TileId& tile, std::string_view content) noexcept {
    ++files;
    bytes += content.size();
    const std::uint64_t place = (static_cast<std::uint64_t>(tile.x) << 32) | static_cast<std::uint64_t>(tile.y);
    checksum += checksumOf(content, mixed(static_cast<std::uint64_t>(tile.level), place));
}

}  // namespace osgbindem

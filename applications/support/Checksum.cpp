// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Checksum.h"

#include <cstring>

namespace osgAnalyticBin::support {

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

std::string withChecksum(std::string bytes) {
    const std::uint64_t checksum = checksumOf(bytes);
    return std::move(bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum));
}

std::optional<std::string_view> wholeBytes(std::string_view bytes) noexcept {
    std::uint64_t checksum = 0;
    if (bytes.size() < sizeof checksum) return std::nullopt;
    const std::string_view whole = bytes.substr(0, bytes.size() - sizeof checksum);
    std::memcpy(&checksum, bytes.data() + whole.size(), sizeof checksum);
    if (checksum != checksumOf(whole)) return std::nullopt;
    return whole;
}

}  // namespace osgAnalyticBin::support

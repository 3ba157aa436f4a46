// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace osgAnalyticBin::indexing {

/// A cyclic redundancy check as zlib computes it: bits reflected, all ones at the beginning, inverted at the end.
/// `kPolynomial`: its bits, reflected. `sum`: the checksum of the bytes before.
template <class T, T kPolynomial>
[[nodiscard]] T checksum(std::string_view bytes, T sum) noexcept {
    static constexpr auto kOfByte = [] {
        std::array<T, 256> table{};
        for (unsigned int i = 0; i < 8 * table.size(); ++i) {
            T& rest = table[i / 8];
            if (i % 8 == 0) rest = i / 8;
            rest = (rest >> 1) ^ (rest & 1u ? kPolynomial : 0u);
        }
        return table;
    }();
    sum = ~sum;
    for (const char byte : bytes) sum = kOfByte[(sum ^ static_cast<unsigned char>(byte)) & 0xFFu] ^ (sum >> 8);
    return ~sum;
}

[[nodiscard]] inline std::uint32_t crc32(std::string_view bytes, std::uint32_t sum = 0) noexcept {
    return checksum<std::uint32_t, 0xEDB88320u>(bytes, sum);
}
[[nodiscard]] inline std::uint64_t crc64(std::string_view bytes) noexcept {
    return checksum<std::uint64_t, 0xC96C5795D7870F42u>(bytes, 0);
}

}  // namespace osgAnalyticBin::indexing

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <bitset>
#include <cstdint>

namespace osgAnalyticBin {

/// Requires: count <= 64.
[[nodiscard]] inline std::uint64_t lowestBits(unsigned int count) {
    return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

[[nodiscard]] inline bool hasBit(std::uint64_t bits, unsigned int number) {
    return (bits >> number & 1) != 0;
}

[[nodiscard]] inline std::uint32_t countBits(std::uint64_t bits) {
    return bits == 0 ? 0 : static_cast<std::uint32_t>(std::bitset<64>(bits).count());
}

/// Calls `visit(number)` for each bit that is set, the lowest first.
template <class Visit>
void forEachBit(std::uint64_t bits, const Visit& visit) {
    for (unsigned int number = 0; bits != 0; ++number, bits >>= 1) {
        if (bits & 1) visit(number);
    }
}

}  // namespace osgAnalyticBin

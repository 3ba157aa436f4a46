// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <bitset>
#include <cstdint>

#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#endif

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

/// The number of the lowest bit. Requires: one is set.
[[nodiscard]] inline unsigned firstBit(std::uint64_t bits) noexcept {
#if defined(_MSC_VER) && !defined(__clang__)
    unsigned long first = 0;
    _BitScanForward64(&first, bits);
    return static_cast<unsigned>(first);
#else
    return static_cast<unsigned>(__builtin_ctzll(bits));
#endif
}

/// Calls `visit(number)` for each bit that is set, the lowest first.
template <class Visit>
void forEachBit(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(firstBit(bits));
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace osgAnalyticBin {

constexpr std::uintptr_t kCacheLine = 64;  // bytes

/// Prefetches cache lines. Nothing is read, so what was at the address may be gone.
inline void prefetchLines([[maybe_unused]] std::uintptr_t address, [[maybe_unused]] std::uintptr_t lines) {
#ifdef __GNUC__
    for (; lines > 0; --lines, address += kCacheLine) {
        __builtin_prefetch(reinterpret_cast<const void*>(address));
        // GCC leaves out calls of functions that do nothing but this
        __asm__ volatile("" : : "r"(address));
    }
#endif
}

}  // namespace osgAnalyticBin

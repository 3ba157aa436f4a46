// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <cstdint>

namespace osgAnalyticBin {

/// Prefetches what a traversal reads of a node: its masks, callbacks and state, and `lines` cache lines from there on.
/// Nothing is read, so what was at the address may be gone.
inline void prefetchNode([[maybe_unused]] const osg::Node& node, [[maybe_unused]] unsigned int lines) {
#ifdef __GNUC__
    constexpr std::uintptr_t kLine = 64;  // bytes; parents and the bound come before the third one
    for (std::uintptr_t at = reinterpret_cast<std::uintptr_t>(&node) + 2 * kLine; lines > 0; --lines, at += kLine) {
        __builtin_prefetch(reinterpret_cast<const void*>(at));
        // GCC leaves out calls of functions that do nothing but this
        __asm__ volatile("" : : "r"(at));
    }
#endif
}

}  // namespace osgAnalyticBin

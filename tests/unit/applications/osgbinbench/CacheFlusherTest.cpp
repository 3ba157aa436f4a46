// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CacheFlusher.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::bench {
namespace {

TEST(CacheFlusher, ReadsAndWritesEveryCacheLine) {
    CacheFlusher caches(3);
    ASSERT_EQ(caches.buffer().size(), 3U << 20U);
    caches.flush();
    caches.flush();
    for (std::size_t line = 0; line < caches.buffer().size(); line += CacheFlusher::kCacheLine)
        ASSERT_EQ(caches.buffer()[line], 2) << line;  // the second flush has read what the first one wrote
}

}  // namespace
}  // namespace osgAnalyticBin::bench

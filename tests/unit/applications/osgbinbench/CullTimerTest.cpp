// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTimer.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::bench {
namespace {

TEST(CullTimer, TouchesEveryCacheLine) {
    std::vector<unsigned char> memory(3U << 20U);
    touchEveryLine(memory);
    touchEveryLine(memory);
    for (std::size_t line = 0; line < memory.size(); line += kCacheLine)
        ASSERT_EQ(memory[line], 2) << line;  // the second time has read what the first one wrote
}

}  // namespace
}  // namespace osgAnalyticBin::bench

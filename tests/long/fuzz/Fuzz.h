// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

/// What libFuzzer and ReplaySeeds.cpp call with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace osgAnalyticBin::test {

/// Ends the program, in every kind of build, where a property does not hold.
inline void require(bool holds) {
    if (!holds) std::abort();
}

}  // namespace osgAnalyticBin::test

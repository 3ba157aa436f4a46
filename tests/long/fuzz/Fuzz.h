// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

/// What libFuzzer and ReplaySeeds.cpp call with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace osgAnalyticBin::test {

/// Ends the program, in every kind of build, where a property does not hold.
inline void require(bool holds) {
    if (!holds) std::abort();
}

/// What a failure says has to be one line.
inline void requireOneLine(const std::runtime_error& failure) {
    const std::string text = failure.what();
    require(!text.empty() && text.find('\n') == std::string::npos);
}

}  // namespace osgAnalyticBin::test

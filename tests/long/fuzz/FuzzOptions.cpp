// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The pseudo-loader's parameters: what is read is in range, and is written so that it reads back the same.

#include "Fuzz.h"

#include <osgAnalyticBin/CullOptions.h>

#include <cmath>

using namespace osgAnalyticBin;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string error;
    const auto options = cullOptionsFromText(std::string(reinterpret_cast<const char*>(data), size), error);
    test::require(options.has_value() == error.empty());
    if (!options) return 0;
    test::require(std::isfinite(options->horizon) && options->expiry >= 0.0);
    test::require(options->heights.lower <= options->heights.upper);
    const auto again = cullOptionsFromText(toText(*options), error);
    test::require(again && toText(*again) == toText(*options));
    return 0;
}

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>

namespace osgAnalyticBin::support {

/// For options that are numbers: as CLI::Range, which lets "nan" pass.
[[nodiscard]] inline CLI::Validator within(double lower, double upper) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", lower, upper);
    const std::string complaint = std::string(" is not in ") + range;
    return CLI::Validator(
        [=](const std::string& word) {
            double value = 0.0;
            const bool isNumber = CLI::detail::lexical_cast(word, value);
            return isNumber && value >= lower && value <= upper ? std::string() : word + complaint;
        },
        "FLOAT");
}

}  // namespace osgAnalyticBin::support

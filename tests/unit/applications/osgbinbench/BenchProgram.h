// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::test {

/// Runs osgbinbench on a virtual display, for five minutes at most.
[[nodiscard]] Outcome runBench(const std::string& arguments);

/// Runs osgbinbench without any display.
[[nodiscard]] Outcome runBenchBlind(const std::string& arguments);

/// What a JSON file says; null when it cannot be read.
[[nodiscard]] nlohmann::json jsonFile(const std::string& file);

}  // namespace osgAnalyticBin::test

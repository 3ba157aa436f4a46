// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// Runs osgbinbench on a virtual display, for five minutes at most.
[[nodiscard]] inline Outcome runBench(const std::string& arguments) {
    constexpr int kMostSeconds = 300;
    return runOnDisplay(quoted(BENCH_FILE) + ' ' + arguments, kMostSeconds);
}

/// Runs osgbinbench without any display.
[[nodiscard]] inline Outcome runBenchBlind(const std::string& arguments) {
    return runStock(quoted(BENCH_FILE) + ' ' + arguments, Modules::Absent, "-u DISPLAY ASAN_OPTIONS=detect_leaks=0");
}

/// What a JSON file says; null when it cannot be read.
[[nodiscard]] inline nlohmann::json jsonFile(const std::string& file) {
    return nlohmann::json::parse(textOfFile(file), nullptr, false);
}

}  // namespace osgAnalyticBin::test

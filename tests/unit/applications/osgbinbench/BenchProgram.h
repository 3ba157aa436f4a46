// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <support/Programs.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

inline std::string benchCommand(std::vector<std::string> words) {
    words.insert(words.begin(), BENCH_FILE);
    return quoted(words);
}

/// Runs osgbinbench on a virtual display, for five minutes at most.
[[nodiscard]] inline Outcome runBench(const std::vector<std::string>& words) {
    constexpr int kMostSeconds = 300;
    return runOnDisplay(benchCommand(words), kMostSeconds);
}

/// Runs osgbinbench without any display.
[[nodiscard]] inline Outcome runBenchBlind(const std::vector<std::string>& words) {
    return runStock("timeout 300 " + benchCommand(words), Modules::Absent, "-u DISPLAY ASAN_OPTIONS=detect_leaks=0");
}

/// What a JSON file says; null when it cannot be read.
[[nodiscard]] inline nlohmann::json jsonFile(const std::string& file) {
    return nlohmann::json::parse(textOfFile(file), nullptr, false);
}

}  // namespace osgAnalyticBin::test

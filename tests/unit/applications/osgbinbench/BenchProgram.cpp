// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BenchProgram.h"

#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

Outcome runBench(const std::string& arguments) {
    constexpr int kMostSeconds = 300;
    return runOnDisplay(quoted(BENCH_FILE) + ' ' + arguments, kMostSeconds);
}

Outcome runBenchBlind(const std::string& arguments) {
    return runStock(quoted(BENCH_FILE) + ' ' + arguments, Modules::Absent, "-u DISPLAY ASAN_OPTIONS=detect_leaks=0");
}

nlohmann::json jsonFile(const std::string& file) {
    return nlohmann::json::parse(textOfFile(file), nullptr, false);
}

}  // namespace osgAnalyticBin::test

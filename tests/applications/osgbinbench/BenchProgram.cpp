// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BenchProgram.h"

#include <filesystem>
#include <support/TemporaryFolder.h>
#include <unistd.h>

namespace osgAnalyticBin::test {

bool canRunBench() {
    return std::filesystem::exists(XVFB_RUN_FILE);
}

Outcome runBench(const std::string& arguments) {
    // display numbers by process, so that tests may run side by side
    const std::string display = quoted(XVFB_RUN_FILE) + " -a -n " + std::to_string(100 + getpid() % 5000) +
                                " -s '-screen 0 640x480x24' timeout 300 ";
    return runStock(display + quoted(BENCH_FILE) + ' ' + arguments, Modules::Absent,
                    "LIBGL_ALWAYS_SOFTWARE=1 ASAN_OPTIONS=detect_leaks=0");
}

Outcome runBenchBlind(const std::string& arguments) {
    return runStock(quoted(BENCH_FILE) + ' ' + arguments, Modules::Absent, "-u DISPLAY ASAN_OPTIONS=detect_leaks=0");
}

nlohmann::json jsonFile(const std::string& file) {
    return nlohmann::json::parse(textOfFile(file), nullptr, false);
}

}  // namespace osgAnalyticBin::test

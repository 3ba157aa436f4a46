// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>
#include <sys/wait.h>
#include <unistd.h>

namespace osgAnalyticBin::test {

int Outcome::linesWith(const std::string& part) const {
    std::istringstream lines(text);
    int count = 0;
    for (std::string line; std::getline(lines, line);) count += line.find(part) != std::string::npos ? 1 : 0;
    return count;
}

std::string quoted(const std::string& text) {
    return "'" + text + "'";
}

Outcome runStock(const std::string& command, Modules modules, const std::string& environment) {
    std::string line = "env -u OSG_LIBRARY_PATH -u LD_LIBRARY_PATH " + environment;
    if (modules == Modules::Present) {
        line += " OSG_LIBRARY_PATH=" + quoted(LIBRARY_FOLDER);
        // The sanitizers, if our modules are built with them, have to come first; the stock program's leaks are not
        // ours.
        if (*PRELOAD_FILE) line += " ASAN_OPTIONS=detect_leaks=0 LD_PRELOAD=" + quoted(PRELOAD_FILE);
    }
    const TemporaryFolder folder;
    const std::string log = folder / "log.txt";
    Outcome outcome;
    // xvfb-run itself may fail, where several displays come and go at once.
    for (int attempt = 0; attempt < 3; ++attempt) {
        const int status = std::system((line + ' ' + command + " >" + quoted(log) + " 2>&1").c_str());
        outcome = {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOfFile(log)};
        if (outcome.linesWith("xvfb-run: error") == 0) break;
    }
    return outcome;
}

bool canRunViewer() {
    return std::filesystem::exists(XVFB_RUN_FILE) && std::filesystem::exists(OSGVIEWER_FILE);
}

Outcome runViewer(const std::string& arguments, Modules modules, const std::string& environment) {
    // display numbers by process, so that tests may run side by side; the preload is not for the display
    const std::string display = quoted(XVFB_RUN_FILE) + " -a -n " + std::to_string(100 + getpid() % 5000) +
                                " -s '-screen 0 640x480x24' timeout 120 env ";
    const std::string preload =
        modules == Modules::Present && *PRELOAD_FILE ? "LD_PRELOAD=" + quoted(PRELOAD_FILE) + ' ' : std::string();
    const std::string own =
        "OSG_WINDOW='0 0 320 240' LIBGL_ALWAYS_SOFTWARE=1 ASAN_OPTIONS=detect_leaks=0 " + environment;
    const std::string path =
        modules == Modules::Present ? " OSG_LIBRARY_PATH=" + quoted(LIBRARY_FOLDER) : std::string();
    return runStock(display + preload + quoted(OSGVIEWER_FILE) + ' ' + arguments, Modules::Absent, own + path);
}

Outcome runOsgconv(const std::string& arguments, Modules modules) {
    return runStock(quoted(OSGCONV_FILE) + ' ' + arguments, modules);
}

}  // namespace osgAnalyticBin::test

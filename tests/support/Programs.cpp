// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <support/Programs.h>
#include <support/TemporaryFolder.h>
#include <sys/wait.h>

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

std::string quoted(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
    return line;
}

std::string onFullDisk(const std::string& command, int blocks) {
    return "sh -c \"ulimit -f " + std::to_string(blocks) + "; exec " + command + '"';
}

std::string interrupted(const std::string& command, const std::string& condition, const std::string& meanwhile) {
    // In the background a shell without job control has SIGINT ignored; our programs take it all the same.
    return "sh -c \"" + command + " & until " + condition +
           "; do kill -0 \\$! 2>/dev/null || break; sleep 0.01; done; " + meanwhile +
           "; kill -INT \\$! 2>/dev/null; wait \\$!\"";
}

Outcome runStock(const std::string& command, Modules modules, const std::string& environment) {
    std::string line = "env -u OSG_LIBRARY_PATH -u LD_LIBRARY_PATH " + environment;
    if (modules == Modules::Present) {
        line += " OSG_LIBRARY_PATH=" + quoted(LIBRARY_FOLDER);
        // sanitizers that our modules are built with have to come first; leaks of the stock program are not ours
        if (*PRELOAD_FILE) line += " ASAN_OPTIONS=detect_leaks=0 LD_PRELOAD=" + quoted(PRELOAD_FILE);
    }
    const TemporaryFolder folder;
    const std::string log = folder / "log.txt";
    const int status = std::system((line + ' ' + command + " >" + quoted(log) + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOfFile(log)};
}

bool hasDisplay() {
    return std::filesystem::exists(XVFB_RUN_FILE);
}

Outcome runOnDisplay(const std::string& command, int seconds, const std::string& environment) {
    return runStock(
        "sh " + quoted(DISPLAY_SCRIPT) + " timeout " + std::to_string(seconds) + " env " + environment + ' ' + command,
        Modules::Absent, "LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=0 ASAN_OPTIONS=detect_leaks=0");
}

bool canRunViewer() {
    return hasDisplay() && std::filesystem::exists(OSGVIEWER_FILE);
}

Outcome runViewer(const std::string& arguments, Modules modules, const std::string& environment) {
    constexpr int kMostSeconds = 120;
    std::string own = "OSG_WINDOW='0 0 320 240' " + environment;
    if (modules == Modules::Present) {
        own += " OSG_LIBRARY_PATH=" + quoted(LIBRARY_FOLDER);
        if (*PRELOAD_FILE) own += " LD_PRELOAD=" + quoted(PRELOAD_FILE);
    }
    return runOnDisplay(quoted(OSGVIEWER_FILE) + ' ' + arguments, kMostSeconds, own);
}

Outcome runOsgconv(const std::string& arguments, Modules modules) {
    return runStock(quoted(OSGCONV_FILE) + ' ' + arguments, modules);
}

}  // namespace osgAnalyticBin::test

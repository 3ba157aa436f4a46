// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Plot.h"

#include "Failure.h"
#include "Output.h"

#include <cerrno>
#include <filesystem>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace osgAnalyticBin::bench {

namespace {

// Returns: the exit code, -1 after a signal, nullopt when there is no gnuplot.
std::optional<int> runGnuplot(const std::string& folder, const std::string& script) {
    std::string name = "gnuplot";
    std::string argument = script;
    char* const arguments[] = {name.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    pid_t process = 0;
    const int problem = posix_spawnp(&process, name.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) return std::nullopt;
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void plot(const std::string& folder, const std::vector<Diagram>& diagrams) {
    namespace fs = std::filesystem;
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) throw Failure("--plot: folder " + folder + " cannot be made");
    for (const Diagram& diagram : diagrams) {
        writeFile((fs::path(folder) / (diagram.name + ".csv")).string(), diagram.data);
        writeFile((fs::path(folder) / (diagram.name + ".gp")).string(), diagram.script);
    }
    for (const Diagram& diagram : diagrams) {
        const std::string script = diagram.name + ".gp";
        const auto code = runGnuplot(folder, script);
        if (!code)
            throw Failure("--plot: gnuplot is not installed (Debian: gnuplot-nox); then run it on the scripts in " +
                          folder + ": cd " + folder + " && gnuplot *.gp");
        if (*code != 0)
            throw Failure("--plot: gnuplot failed on " + (fs::path(folder) / script).string() + "; it says why above");
    }
}

}  // namespace osgAnalyticBin::bench

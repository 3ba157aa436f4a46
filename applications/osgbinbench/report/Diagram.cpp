// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Diagram.h"

#include "Failure.h"
#include "TextFile.h"

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

namespace osgAnalyticBin::report {

using support::Failure;

namespace {

std::string quotedForShell(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

void plot(const std::string& folder, const std::vector<Diagram>& diagrams) {
    namespace fs = std::filesystem;
    constexpr int kNoProgram = 127;  // as the shell says it
    support::makeFolder(folder);
    for (const Diagram& diagram : diagrams) {
        support::writeFile((fs::path(folder) / (diagram.name + ".csv")).string(), diagram.data);
        support::writeFile((fs::path(folder) / (diagram.name + ".gp")).string(), diagram.script);
    }
    for (const Diagram& diagram : diagrams) {
        const std::string script = diagram.name + ".gp";
        const std::string command = "cd " + quotedForShell(folder) +
                                    " && { command -v gnuplot >/dev/null || exit 127; } && exec gnuplot " + script;
        const int status = std::system(command.c_str());
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        if (code == kNoProgram)
            throw Failure("--plot: gnuplot is not installed (Debian: gnuplot-nox); then run it on the scripts in " +
                          folder + ": cd " + folder + " && gnuplot *.gp");
        if (code != 0)
            throw Failure("--plot: gnuplot failed on " + (fs::path(folder) / script).string() + "; it says why above");
    }
}

std::string drawnTwice(const std::string& name, const std::string& settings, const std::string& commands) {
    std::string script = "# Drawn by: gnuplot " + name + ".gp\nname = '" + name + "'\n";
    for (const char* const terminal : {"svg background 'white'", "pngcairo"}) {
        const std::string ending = *terminal == 's' ? ".svg" : ".png";
        script += std::string("reset\nset terminal ") + terminal + " " + settings + "\nset output '" + name + ending +
                  "'\n" + commands + "unset multiplot\nunset output\n";
    }
    return script;
}

}  // namespace osgAnalyticBin::report

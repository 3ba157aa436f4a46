// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Diagram.h"

#include "Failure.h"
#include "GnuplotRun.h"
#include "TextFile.h"

#include <filesystem>

namespace osgAnalyticBin::report {

using support::Failure;

void plot(const std::string& folder, const std::vector<Diagram>& diagrams) {
    namespace fs = std::filesystem;
    support::makeFolder("--plot", folder);
    for (const Diagram& diagram : diagrams) {
        support::writeFile((fs::path(folder) / (diagram.name + ".csv")).string(), diagram.data);
        support::writeFile((fs::path(folder) / (diagram.name + ".gp")).string(), diagram.script);
    }
    for (const Diagram& diagram : diagrams) {
        const std::string script = diagram.name + ".gp";
        const auto code = support::runGnuplot({{script}, "", folder, ""});
        if (!code)
            throw Failure("--plot: gnuplot is not installed (Debian: gnuplot-nox); then run it on the scripts in " +
                          folder + ": cd " + folder + " && gnuplot *.gp");
        if (*code != 0)
            throw Failure("--plot: gnuplot failed on " + (fs::path(folder) / script).string() + "; it says why above");
    }
}

}  // namespace osgAnalyticBin::report

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"

#include "Failure.h"

#include <osgAnalyticBin/Version.h>

#include <cstdio>
#include <sstream>

namespace osgAnalyticBin::support {

CLI::Validator within(double lower, double upper) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", lower, upper);
    const std::string complaint = std::string(" is not in ") + range;
    return CLI::Validator(
        [=](const std::string& word) {
            double value = 0.0;
            const bool isNumber = CLI::detail::lexical_cast(word, value);
            return isNumber && value >= lower && value <= upper ? std::string() : word + complaint;
        },
        "FLOAT");
}

void parseParameters(CLI::App& app, const std::string& text) {
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) {
        CLI::detail::trim(item);
        try {
            app.parse(std::vector<std::string>{"--" + item});
        } catch (const CLI::ParseError&) {
            std::string allowed;
            for (const CLI::Option* option : app.get_options())
                allowed += (allowed.empty() ? "" : ", ") + parameterText(*option);
            throw Failure("unknown or malformed parameter \"" + item + "\"; allowed are " + allowed);
        }
    }
}

bool parseCommandLine(CLI::App& app, int argc, const char* const* argv) {
    app.set_version_flag("--version", app.get_name() + " (osgAnalyticBin) " + version());
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0)
            throw UsageError(std::string(error.what()) + "; see " + app.get_name() + " --help");
        (void)app.exit(error);
        return false;
    }
}

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace osgAnalyticBin::support {

/// For options that are numbers: as CLI::Range, which lets "nan" pass.
[[nodiscard]] CLI::Validator within(double lower, double upper);

/// Adds an option for a list that is one word, with commas.
template <class List>
CLI::Option* addList(CLI::App& app, const char* name, List& list, const char* description) {
    return app.add_option(name, list, description)->delimiter(',')->allow_extra_args(false);
}

/// Reads "key=value,key=value", the parameters in the brackets of a pseudo-loader's name, by options --key.
/// Throws Failure for one that is unknown or malformed.
void parseParameters(CLI::App& app, const std::string& text);

/// What is said of such an option: "frames=1..1000".
[[nodiscard]] inline std::string parameterText(const CLI::Option& option) {
    return option.get_single_name() + "=" + option.get_option_text();
}

/// Parses the command line, which has --version besides; prints the help or the version when it asks for them.
/// Returns: whether there is something to do. Throws UsageError.
[[nodiscard]] bool parseCommandLine(CLI::App& app, int argc, const char* const* argv);

}  // namespace osgAnalyticBin::support

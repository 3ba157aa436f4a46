// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>

namespace osgAnalyticBin::support {

/// For options that are numbers: as CLI::Range, which lets "nan" pass.
[[nodiscard]] CLI::Validator within(double lower, double upper);

/// Parses the command line, which has --version besides; prints the help or the version when it asks for them.
/// Returns: whether there is something to do. Throws UsageError.
[[nodiscard]] bool parseCommandLine(CLI::App& app, int argc, const char* const* argv);

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string>

namespace osgAnalyticBin::support {

/// The exit codes of all programs.
enum ExitCode : int {
    kSucceeded = 0,
    kFailed = 1,         ///< something failed, or what was compared differs
    kWrongUsage = 2,     ///< the command line is wrong
    kInterrupted = 130,  ///< the user stopped the program
};

/// Runs a program and prints what it throws as one line on stderr, the program's name before it.
/// Returns: the exit code, which `run` returns or what it throws stands for.
[[nodiscard]] ExitCode runProgram(const std::string& name, const std::function<ExitCode()>& run);

}  // namespace osgAnalyticBin::support

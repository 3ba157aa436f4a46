// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::support {

/// One run of gnuplot.
struct GnuplotRun {
    std::vector<std::string> arguments;
    std::string commands;  ///< for its standard input
    std::string folder;    ///< where it runs; empty: where this program does
    std::string messages;  ///< the file for all that it says; empty: it says that on this program's streams
};

/// Runs gnuplot and waits for its end. No signal reaches this program when gnuplot does not read its commands.
/// Returns: the exit code, -1 after a signal, nullopt when there is no gnuplot.
[[nodiscard]] std::optional<int> runGnuplot(const GnuplotRun& run);

/// A string of gnuplot in single quotes.
[[nodiscard]] std::string quotedForGnuplot(const std::string& text);

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Whether our modules are on the plugin path of a stock program.
enum class Modules { Absent, Present };

/// How a program ended, and what it said on both streams.
struct Outcome {
    int code = -1;  // -1: by a signal
    std::string text;

    [[nodiscard]] int linesWith(const std::string& part) const;
};

/// For the shell.
[[nodiscard]] std::string quoted(const std::string& text);

/// Runs a shell command with a clean plugin path. `environment`: more assignments, parted by blanks.
[[nodiscard]] Outcome runStock(const std::string& command, Modules modules, const std::string& environment = {});

/// Whether xvfb-run is installed, which makes virtual displays.
[[nodiscard]] bool hasDisplay();

/// Runs a shell command on its own virtual display, for `seconds` at most. Returns: the exit code of the command, not
/// that of xvfb-run.
[[nodiscard]] Outcome runOnDisplay(const std::string& command, int seconds, const std::string& environment = {});

[[nodiscard]] bool canRunViewer();

/// Runs the stock osgviewer on a virtual display, for two minutes at most.
[[nodiscard]] Outcome runViewer(const std::string& arguments, Modules modules, const std::string& environment = {});

/// Runs the stock osgconv.
[[nodiscard]] Outcome runOsgconv(const std::string& arguments, Modules modules);

}  // namespace osgAnalyticBin::test

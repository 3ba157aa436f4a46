// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

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
/// A command line: each word quoted.
[[nodiscard]] std::string quoted(const std::vector<std::string>& words);

/// The command with so many blocks of 512 bytes as the most that a file may have, which stands in for a full disk.
/// Requires: words in single quotes alone.
[[nodiscard]] std::string onFullDisk(const std::string& command, int blocks);

/// Runs a shell command with a clean plugin path. `environment`: more assignments, parted by blanks.
[[nodiscard]] Outcome runStock(const std::string& command, Modules modules, const std::string& environment = {});

/// A command that runs `command` in the background, waits until `condition`, a command itself, succeeds or the program
/// ends, then runs `meanwhile` and presses Ctrl-C. Its exit code is that of `command`.
[[nodiscard]] std::string interrupted(const std::string& command, const std::string& condition,
                                      const std::string& meanwhile = ":");

/// Whether xvfb-run is installed, which makes virtual displays.
[[nodiscard]] bool hasDisplay();

/// Runs a shell command on its own virtual display, for `seconds` at most. Returns: the exit code of the command.
[[nodiscard]] Outcome runOnDisplay(const std::string& command, int seconds, const std::string& environment = {});

[[nodiscard]] bool canRunViewer();

/// Runs the stock osgviewer on a virtual display, for two minutes at most.
[[nodiscard]] Outcome runViewer(const std::string& arguments, Modules modules, const std::string& environment = {});

/// Runs the stock osgconv.
[[nodiscard]] Outcome runOsgconv(const std::string& arguments, Modules modules);

/// What the failure says that `call` ends with: one line. "no failure" where it ends with none.
template <typename Call>
std::string failureOf(const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& failure) {
        EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << failure.what();
        return failure.what();
    }
    return "no failure";
}

/// The program has ended with this code and has said one line: its name, and `what` somewhere in it.
inline void expectOneLine(const Outcome& outcome, const std::string& program, const std::string& what, int code = 1) {
    EXPECT_EQ(outcome.code, code) << outcome.text;
    EXPECT_EQ(outcome.text.rfind(program + ": ", 0), 0U) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << what << " is not in " << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
}

}  // namespace osgAnalyticBin::test

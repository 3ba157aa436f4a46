// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace osgAnalyticBin::support {

/// Estimates the time that is left when `share` (0 to 1) of the work is done after `seconds`, of which `skipped` was
/// done before: "12 min left". Empty in the first seconds, when the estimate would be too rough.
[[nodiscard]] std::string timeLeft(double share, double seconds, double skipped = 0.0);

/// A line that says how far a program is, with the time that is left. On a terminal it is written over five times a
/// second, and erased when the work ends early, so that an error begins at the start of a line. Elsewhere a new line is
/// written every ten seconds. Not for several threads at once.
class ProgressLine final {
public:
    explicit ProgressLine(std::FILE* stream);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    [[nodiscard]] bool isTerminal() const noexcept { return _isTerminal; }
    /// Since the start.
    [[nodiscard]] double seconds() const;
    /// Whether it is time for another line.
    [[nodiscard]] bool isDue() const { return Clock::now() - _shown >= _pause; }

    /// This share of the work was done before: it says nothing of the time that the rest takes.
    void skip(double share) { _skipped += share; }
    /// `share`: of the work that is done, 0 to 1, with what was skipped. `text`: what is said before it.
    void show(double share, const std::string& text);
    /// The last line; `share` is 1 there, but for its rounding.
    void finish(double share, const std::string& text);

private:
    using Clock = std::chrono::steady_clock;

    void write(const std::string& line, const char* end);

    std::FILE* _stream;
    bool _isTerminal;
    std::chrono::milliseconds _pause;
    Clock::time_point _start = Clock::now();
    Clock::time_point _shown = _start;
    double _skipped = 0.0;
    int _width = 0;
};

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::paper {

/// Says on stderr how far a step is: in place on a terminal, one line a step elsewhere.
class Progress final {
public:
    explicit Progress(bool isQuiet);

    void show(const std::string& step, std::size_t done, std::size_t all);

    /// Ends the line of the last step.
    void finish();

private:
    bool _isQuiet;
    bool _isTerminal;
    std::string _step;
    std::size_t _percent = 0;
};

}  // namespace osgAnalyticBin::paper

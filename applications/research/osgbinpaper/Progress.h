// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ProgressLine.h"

#include <cstddef>
#include <optional>
#include <string>

namespace osgAnalyticBin::paper {

/// Says on stderr how far each step is.
class Progress final {
public:
    explicit Progress(bool isQuiet) : _isQuiet(isQuiet) {}

    void show(const std::string& step, std::size_t done, std::size_t all) {
        if (_isQuiet) return;
        if (step != _step) finish();
        if (!_line) _line.emplace(stderr);
        _step = step;
        if (_line->isDue()) _line->show(static_cast<double>(done) / static_cast<double>(all), step + ": ");
    }

    /// Ends the line of the last step.
    void finish() {
        if (_line) _line->finish(1.0, _step + ": ");
        _line.reset();
    }

private:
    bool _isQuiet;
    std::string _step;
    std::optional<support::ProgressLine> _line;
};

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Progress.h"

#include <cstdio>
#include <unistd.h>

namespace osgAnalyticBin::paper {

Progress::Progress(bool isQuiet) : _isQuiet(isQuiet), _isTerminal(isatty(STDERR_FILENO) != 0) {}

void Progress::show(const std::string& step, std::size_t done, std::size_t all) {
    const std::size_t percent = all > 0 ? 100 * done / all : 100;
    const bool isNew = step != _step;
    if (_isQuiet || (!isNew && (!_isTerminal || percent == _percent))) return;
    if (isNew) finish();
    _step = step;
    _percent = percent;
    if (_isTerminal) {
        std::fprintf(stderr, "\r%-40s %3zu %%", step.c_str(), percent);
    } else {
        std::fprintf(stderr, "%s\n", step.c_str());
    }
    std::fflush(stderr);
}

void Progress::finish() {
    if (!_isQuiet && _isTerminal && !_step.empty()) std::fprintf(stderr, "\n");
    _step.clear();
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Progress.h"

#include <cstdio>
#include <string>
#include <unistd.h>

namespace osgbinconv {

Progress::Progress(bool isQuiet) : _isQuiet(isQuiet), _isTerminal(::isatty(STDERR_FILENO) == 1) {}

void Progress::add(std::size_t tiles) {
    ++_files;
    _tiles += tiles;
    const auto pause = _isTerminal ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
    if (Clock::now() - _shown < pause) return;
    show(_isTerminal ? "\r" : "\n");
}

void Progress::finish() {
    show("\n");
}

void Progress::show(const char* end) {
    if (_isQuiet) return;
    _shown = Clock::now();
    const double seconds = std::chrono::duration<double>(_shown - _start).count();
    const double rate = seconds > 0.0 ? static_cast<double>(_tiles) / seconds : 0.0;
    const std::size_t known = _known.load();
    const std::string before = known > 0 ? " (" + std::to_string(known) + " files from an earlier run)" : "";
    std::fprintf(stderr, "osgbinconv: %zu files, %zu tiles, %.0f tiles/s%s%s", _files, _tiles, rate, before.c_str(),
                 end);
}

}  // namespace osgbinconv

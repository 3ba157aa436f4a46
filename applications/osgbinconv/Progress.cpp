// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Progress.h"

#include <cstdio>

namespace osgbinconv {

Progress::Progress(const char* verb, bool isQuiet) : _verb(verb), _isQuiet(isQuiet) {}

void Progress::add(std::size_t tiles, double share) {
    ++_files;
    _tiles += tiles;
    _share += share;
    if (!_isQuiet && _line.isDue()) _line.show(_share, text());
}

void Progress::addKnown(std::size_t tiles, double share) {
    ++_known;
    _line.skip(share);
    add(tiles, share);
}

void Progress::finish() {
    if (!_isQuiet) _line.finish(_share, text());
}

std::string Progress::text() const {
    const double seconds = _line.seconds();
    const double rate = seconds > 0.0 ? static_cast<double>(_tiles) / seconds : 0.0;
    char text[160];
    std::snprintf(text, sizeof text, "osgbinconv: %s %zu files, %zu tiles, %.0f tiles/s", _verb, _files, _tiles, rate);
    const std::string known = _known > 0 ? " (" + std::to_string(_known) + " files from an earlier run)" : "";
    return text + known + ", ";
}

}  // namespace osgbinconv

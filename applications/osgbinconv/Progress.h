// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ProgressLine.h"

#include <cstddef>
#include <cstdio>
#include <string>

namespace osgbinconv {

/// Says on stderr how far a pass over the files of a database is. Not for several threads at once.
class Progress final {
public:
    explicit Progress(bool isQuiet) : _isQuiet(isQuiet) {}

    /// A file is done, and with it this share of the pass.
    void add(std::size_t tiles, double share) {
        ++_files;
        _tiles += tiles;
        _share += share;
        if (!_isQuiet && _line.isDue()) _line.show(_share, text());
    }
    /// The same of a file that an earlier run had done.
    void addKnown(std::size_t tiles, double share) {
        ++_known;
        _line.skip(share);
        add(tiles, share);
    }
    void finish() {
        if (!_isQuiet) _line.finish(_share, text());
    }

private:
    [[nodiscard]] std::string text() const {
        const double seconds = _line.seconds();
        const double rate = seconds > 0.0 ? static_cast<double>(_tiles) / seconds : 0.0;
        char text[160];
        std::snprintf(text, sizeof text, "osgbinconv: read %zu files, %zu tiles, %.0f tiles/s", _files, _tiles, rate);
        const std::string known = _known > 0 ? " (" + std::to_string(_known) + " files from an earlier run)" : "";
        return text + known + ", ";
    }

    const bool _isQuiet;
    osgAnalyticBin::support::ProgressLine _line{stderr};
    std::size_t _files = 0;
    std::size_t _known = 0;
    std::size_t _tiles = 0;
    double _share = 0.0;
};

}  // namespace osgbinconv

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ProgressLine.h"

#include <cstddef>
#include <string>

namespace osgbinconv {

/// Says on stderr how far a pass over the files of a database is. Not for several threads at once.
class Progress final {
public:
    /// `verb`: what is done with the files.
    Progress(const char* verb, bool isQuiet);

    /// A file is done, and with it this share of the pass.
    void add(std::size_t tiles, double share);
    /// The same of a file that an earlier run had done.
    void addKnown(std::size_t tiles, double share);
    void finish();

private:
    [[nodiscard]] std::string text() const;

    const char* const _verb;
    const bool _isQuiet;
    osgAnalyticBin::support::ProgressLine _line{stderr};
    std::size_t _files = 0;
    std::size_t _known = 0;
    std::size_t _tiles = 0;
    double _share = 0.0;
};

}  // namespace osgbinconv

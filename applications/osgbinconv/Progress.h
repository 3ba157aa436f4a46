// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>

namespace osgbinconv {

/// Tells on stderr how far a walk is: on a terminal in one line that is written over, else in a line every ten seconds,
/// and once at the end. How many files there will be is not known before the end.
class Progress final {
public:
    explicit Progress(bool isQuiet);

    /// A file is done. Not to be called by two threads at once.
    void add(std::size_t tiles);
    /// Of those: one that an earlier run had done.
    void addKnown() { _known.fetch_add(1, std::memory_order_relaxed); }
    void finish();

private:
    using Clock = std::chrono::steady_clock;

    void show(const char* end);

    const bool _isQuiet;
    const bool _isTerminal;
    const Clock::time_point _start = Clock::now();
    Clock::time_point _shown = _start;
    std::size_t _files = 0;
    std::size_t _tiles = 0;
    std::atomic<std::size_t> _known{0};
};

}  // namespace osgbinconv

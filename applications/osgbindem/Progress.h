// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Ranks.h"
#include "TimeLeft.h"

#include <cpl_progress.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <unistd.h>

namespace osgbindem {

/// Shows how much is done; may be used by several threads. On a terminal it is a line that is written over, with the
/// time that is left; elsewhere it is GDAL's row of numbers.
class Progress final {
public:
    Progress(bool isShown, double total)
        : _isShown(isShown), _isTerminal(::isatty(STDOUT_FILENO) == 1 && !Ranks::isStartedByMpi()), _total(total) {
        show(0.0);
    }

    void add(double amount) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        show(std::min(_done / _total, 0.99));
    }
    void finish() {
        const std::lock_guard<std::mutex> guard(_mutex);
        show(1.0);
    }

private:
    using Clock = std::chrono::steady_clock;

    void show(double share) {
        if (!_isShown) return;
        if (_isTerminal) {
            showLine(share);
        } else {
            GDALTermProgress(share, nullptr, nullptr);
        }
    }
    void showLine(double share) {
        constexpr std::chrono::milliseconds kPause{200};
        const Clock::time_point now = Clock::now();
        if (share < 1.0 && share > 0.0 && now - _shown < kPause) return;
        _shown = now;
        const double seconds = std::chrono::duration<double>(now - _start).count();
        const std::string time = share < 1.0 ? osgAnalyticBin::support::timeLeft(share, seconds)
                                             : "done in " + osgAnalyticBin::support::durationText(seconds);
        std::printf("\r%3.0f %%  %-24s%s", 100.0 * share, time.c_str(), share < 1.0 ? "" : "\n");
        std::fflush(stdout);
    }

    std::mutex _mutex;
    const bool _isShown;
    const bool _isTerminal;
    const double _total;
    const Clock::time_point _start = Clock::now();
    Clock::time_point _shown = _start;
    double _done = 0.0;
};

}  // namespace osgbindem

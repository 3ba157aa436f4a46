// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ProgressLine.h"
#include "Ranks.h"

#include <cpl_progress.h>

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace osgbindem {

/// Shows how much is done; may be used by several threads. On a terminal it is a line that is written over, with the
/// time that is left; elsewhere it is GDAL's row of numbers.
class Progress final {
public:
    Progress(bool isShown, double total)
        : _isShown(isShown), _isRow(!_line.isTerminal() || Ranks::isStartedByMpi()), _total(total) {
        show();
    }

    void add(double amount) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        show();
    }
    /// What an earlier run has done.
    void addKnown(double amount) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        _line.skip(amount / _total);
        show();
    }
    void finish() {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_isShown) return;
        if (_isRow) {
            GDALTermProgress(1.0, nullptr, nullptr);
        } else {
            _line.finish(1.0, "");
        }
    }

private:
    void show() {
        if (!_isShown) return;
        if (_isRow) {
            GDALTermProgress(std::min(_done / _total, 0.99), nullptr, nullptr);
        } else if (_line.isDue()) {
            _line.show(_done / _total, "");
        }
    }

    std::mutex _mutex;
    osgAnalyticBin::support::ProgressLine _line{stdout};
    const bool _isShown;
    const bool _isRow;
    const double _total;
    double _done = 0.0;
};

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cpl_progress.h>

#include <algorithm>
#include <mutex>

namespace osgbindem {

/// Shows how much is done, in GDAL's manner; may be used by several threads.
class Progress final {
public:
    Progress(bool isShown, double total) : _isShown(isShown), _total(total) { show(0.0); }

    void add(double amount) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        show(std::min(_done / _total, 0.99));
    }
    void finish() { show(1.0); }

private:
    void show(double share) const {
        if (_isShown) GDALTermProgress(share, nullptr, nullptr);
    }

    std::mutex _mutex;
    const bool _isShown;
    const double _total;
    double _done = 0.0;
};

}  // namespace osgbindem

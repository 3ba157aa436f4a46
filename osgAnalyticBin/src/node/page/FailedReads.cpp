// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FailedReads.h"

#include <algorithm>

namespace osgAnalyticBin {

bool FailedReads::mayRead(const std::string& fileName, Clock::time_point now) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto failure = _failures.find(fileName);
    return failure == _failures.end() || now >= failure->second.next;
}

void FailedReads::note(const std::string& fileName, bool success, Clock::time_point now) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (success) {
        _failures.erase(fileName);
        return;
    }
    Failure& failure = _failures[fileName];
    failure.wait = std::clamp(2 * failure.wait, kFirstWait, kLongestWait);
    failure.next = now + failure.wait;
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace osgAnalyticBin {

/// Files that could not be read, and when each may be tried again: after a second, then after waits that double up to
/// ten seconds. The DatabasePager itself asks again in every frame, which floods a server in trouble and the log.
/// Threads: any number at once.
class FailedReads {
public:
    using Clock = std::chrono::steady_clock;

    static constexpr std::chrono::seconds kFirstWait{1};
    static constexpr std::chrono::seconds kLongestWait{10};

    [[nodiscard]] bool mayRead(const std::string& fileName, Clock::time_point now) const {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto failure = _failures.find(fileName);
        return failure == _failures.end() || now >= failure->second.next;
    }

    /// Records whether reading the file succeeded; success clears earlier failures.
    void note(const std::string& fileName, bool success, Clock::time_point now) {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (success) {
            _failures.erase(fileName);
            return;
        }
        Failure& failure = _failures[fileName];
        failure.wait = std::clamp(2 * failure.wait, kFirstWait, kLongestWait);
        failure.next = now + failure.wait;
    }

private:
    struct Failure {
        Clock::time_point next;
        std::chrono::seconds wait{0};
    };

    mutable std::mutex _mutex;
    std::map<std::string, Failure> _failures;
};

}  // namespace osgAnalyticBin

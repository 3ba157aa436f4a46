// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace osgAnalyticBin::test {

/// Ends the process when the thread that made it does not report for too long: says on stderr what it did last, prints
/// its stack, and aborts.
class Watchdog {
public:
    explicit Watchdog(std::chrono::seconds patience);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    /// Says what the thread does from now on.
    void report(const std::string& what);

private:
    void watch();

    const std::chrono::seconds _patience;
    std::mutex _mutex;  // guards what follows
    std::condition_variable _ended;
    bool _isEnded = false;
    std::string _what;
    std::chrono::steady_clock::time_point _since;
    std::thread _thread;
};

}  // namespace osgAnalyticBin::test

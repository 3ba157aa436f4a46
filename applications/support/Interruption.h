// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <csignal>
#include <stdexcept>
#include <string>

namespace osgAnalyticBin::support {

/// Thrown, in worker threads too, once the user has asked to stop.
class Interrupted final : public std::runtime_error {
public:
    explicit Interrupted(const std::string& message = "interrupted") : std::runtime_error(message) {}
};

/// Set by signals: stopOnSignals().
inline std::atomic<bool> stopRequested{false};

/// From here on SIGINT, SIGTERM and SIGHUP set stopRequested, and a limit of file sizes is an error like a full disk.
inline void stopOnSignals() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { stopRequested.store(true); });
#if !defined(_WIN32)
    std::signal(SIGHUP, [](int) { stopRequested.store(true); });
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

inline void throwIfStopRequested() {
    if (stopRequested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace osgAnalyticBin::support

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <stdexcept>

namespace osgAnalyticBin::support {

/// Thrown, in worker threads too, once the user has asked to stop.
class Interrupted final : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Set by the signal handler of main().
inline std::atomic<bool> stopRequested{false};

inline void throwIfStopRequested() {
    if (stopRequested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace osgAnalyticBin::support

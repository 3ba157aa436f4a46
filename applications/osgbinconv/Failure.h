// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace osgbinconv {

/// An error that ends the program; its text is one line: what, where, what to do.
class Failure final : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Thrown once the user has asked to stop.
class Interrupted final : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Set by the signal handler of main().
inline std::atomic<bool> stopRequested{false};

inline void throwIfStopRequested() {
    if (stopRequested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace osgbinconv

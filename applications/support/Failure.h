// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <csignal>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

namespace osgAnalyticBin::support {

/// An error that ends the program; its text is one line: what, where, what to do.
class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A wrong command line: an unknown option, a value out of its range, options that contradict each other. What is wrong
/// with the files that it names is a Failure.
class UsageError final : public Failure {
public:
    using Failure::Failure;
};

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

/// The exit codes of all programs.
enum ExitCode : int {
    kSucceeded = 0,
    kFailed = 1,         ///< something failed, or what was compared differs
    kWrongUsage = 2,     ///< the command line is wrong
    kInterrupted = 130,  ///< the user stopped the program
};

/// Runs a program and prints what it throws as one line on stderr, the program's name before it.
/// Returns: the exit code, which `run` returns or what it throws stands for.
[[nodiscard]] inline ExitCode runProgram(const std::string& name, const std::function<ExitCode()>& run) {
    const auto complain = [&name](const std::exception& error, ExitCode code) {
        std::cerr << name + ": " + error.what() + '\n' << std::flush;
        return code;
    };
    try {
        return run();
    } catch (const Interrupted& error) {
        return complain(error, kInterrupted);
    } catch (const UsageError& error) {
        return complain(error, kWrongUsage);
    } catch (const std::bad_alloc&) {
        return complain(Failure("out of memory; use fewer --threads, or close other programs"), kFailed);
    } catch (const std::exception& error) {
        return complain(error, kFailed);
    }
}

}  // namespace osgAnalyticBin::support

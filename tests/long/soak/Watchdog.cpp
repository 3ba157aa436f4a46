// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Watchdog.h"

#include <csignal>
#include <cstdlib>
#include <execinfo.h>
#include <iostream>
#include <pthread.h>
#include <unistd.h>

namespace osgAnalyticBin::test {

namespace {

pthread_t watched;

void printStack(int) {
    void* frames[64];
    backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
}

}  // namespace

Watchdog::Watchdog(std::chrono::seconds patience) : _patience(patience), _since(std::chrono::steady_clock::now()) {
    watched = pthread_self();
    (void)std::signal(SIGUSR1, printStack);
    _thread = std::thread([this] { watch(); });
}

Watchdog::~Watchdog() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isEnded = true;
    }
    _ended.notify_all();
    _thread.join();
}

void Watchdog::report(const std::string& what) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _what = what;
    _since = std::chrono::steady_clock::now();
}

void Watchdog::watch() {
    std::unique_lock<std::mutex> lock(_mutex);
    while (!_ended.wait_for(lock, std::chrono::seconds(1), [this] { return _isEnded; })) {
        if (std::chrono::steady_clock::now() - _since < _patience) continue;
        std::cerr << "hangs for " << _patience.count() << " s: " << _what << std::endl;
        pthread_kill(watched, SIGUSR1);
        std::this_thread::sleep_for(std::chrono::seconds(2));
        std::abort();
    }
}

}  // namespace osgAnalyticBin::test

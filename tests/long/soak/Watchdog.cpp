// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Watchdog.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <execinfo.h>
#include <unistd.h>

namespace osgAnalyticBin::test {

namespace {

constexpr unsigned int kPatience = 60;  // seconds
char last[256] = "";

// Linux sends the signal to the main thread.
void onAlarm(int) {
    (void)!write(STDERR_FILENO, last, std::strlen(last));
    void* frames[64];
    backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
    std::abort();
}

}  // namespace

void reportProgress(const std::string& what) {
    (void)std::signal(SIGALRM, onAlarm);
    std::snprintf(last, sizeof last, "hangs for %u s: %s\n", kPatience, what.c_str());
    (void)alarm(kPatience);
}

}  // namespace osgAnalyticBin::test

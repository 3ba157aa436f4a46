// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Process.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <execinfo.h>
#include <malloc.h>
#include <new>
#include <unistd.h>

namespace osgAnalyticBin::test {

namespace {

std::atomic<long long> bytes{0};

void* allocate(std::size_t size) noexcept {
    void* const memory = std::malloc(size > 0 ? size : 1);
    if (memory) bytes.fetch_add(static_cast<long long>(malloc_usable_size(memory)), std::memory_order_relaxed);
    return memory;
}

void release(void* memory) noexcept {
    if (!memory) return;
    bytes.fetch_sub(static_cast<long long>(malloc_usable_size(memory)), std::memory_order_relaxed);
    std::free(memory);
}

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

long long bytesOfObjects() {
    return bytes.load(std::memory_order_relaxed);
}

void reportProgress(const std::string& what) {
    (void)std::signal(SIGALRM, onAlarm);
    std::snprintf(last, sizeof last, "hangs for %u s: %s\n", kPatience, what.c_str());
    (void)alarm(kPatience);
}

}  // namespace osgAnalyticBin::test

// The process's operator new and delete: malloc's, counted. Forms that are left out call these.

void* operator new(std::size_t size) {
    if (void* memory = osgAnalyticBin::test::allocate(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    osgAnalyticBin::test::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    osgAnalyticBin::test::release(memory);
}

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The process's operator new and delete: malloc's, counted.

#include "CountedNew.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <malloc.h>
#include <new>

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

}  // namespace

long long bytesOfObjects() {
    return bytes.load(std::memory_order_relaxed);
}

}  // namespace osgAnalyticBin::test

// clang-format off
void* operator new(std::size_t size) {
    if (void* memory = osgAnalyticBin::test::allocate(size)) return memory;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return osgAnalyticBin::test::allocate(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return osgAnalyticBin::test::allocate(size); }
void operator delete(void* memory) noexcept { osgAnalyticBin::test::release(memory); }
void operator delete[](void* memory) noexcept { osgAnalyticBin::test::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { osgAnalyticBin::test::release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { osgAnalyticBin::test::release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { osgAnalyticBin::test::release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { osgAnalyticBin::test::release(memory); }
// clang-format on

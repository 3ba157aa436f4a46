// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "OcclusionSearch.h"

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

namespace osgAnalyticBin {

/// A thread that makes one search after the other. It begins with the first one, and then waits for others: to begin a
/// thread takes longer than to wake one.
class SearchThread final {
public:
    SearchThread() = default;
    /// Waits for the search that is being made.
    ~SearchThread();
    SearchThread(const SearchThread&) = delete;
    SearchThread& operator=(const SearchThread&) = delete;

    /// Starts a search; where no thread can be had, it makes it at once. Requires: the one before has ended.
    [[nodiscard]] std::future<FoundPtr> start(std::function<FoundPtr()> search);

private:
    void run();

    std::mutex _mutex;
    std::condition_variable _changed;
    std::packaged_task<FoundPtr()> _next;  // invalid: none
    bool _isEnding = false;
    std::thread _thread;
};

}  // namespace osgAnalyticBin

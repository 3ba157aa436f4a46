// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SearchThread.h"

#include <system_error>
#include <utility>

namespace osgAnalyticBin {

SearchThread::~SearchThread() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isEnding = true;
    }
    _changed.notify_one();
    if (_thread.joinable()) _thread.join();
}

std::future<FoundPtr> SearchThread::start(std::function<FoundPtr()> search) {
    std::packaged_task<FoundPtr()> task(std::move(search));
    std::future<FoundPtr> found = task.get_future();
    try {
        if (!_thread.joinable()) _thread = std::thread([this] { run(); });
    } catch (const std::system_error&) {
        task();
        return found;
    }
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _next = std::move(task);
    }
    _changed.notify_one();
    return found;
}

void SearchThread::run() {
    std::unique_lock<std::mutex> lock(_mutex);
    while (true) {
        _changed.wait(lock, [this] { return _isEnding || _next.valid(); });
        if (!_next.valid()) return;
        std::packaged_task<FoundPtr()> task = std::move(_next);
        lock.unlock();
        task();
        lock.lock();
    }
}

}  // namespace osgAnalyticBin

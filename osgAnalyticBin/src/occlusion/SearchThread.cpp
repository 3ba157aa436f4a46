// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SearchThread.h"

#include <system_error>
#include <utility>

#if __has_include(<sched.h>)
#include <sched.h>
#endif

namespace osgAnalyticBin {

namespace {

// Makes the calling thread a batch thread where the system has them: when it is woken, it does not preempt the thread
// that woke it, which is culling.
void becomeBatchThread() {
#ifdef SCHED_BATCH
    const sched_param none{};
    (void)sched_setscheduler(0, SCHED_BATCH, &none);
#endif
}

}  // namespace

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
    becomeBatchThread();
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

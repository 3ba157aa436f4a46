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

// A thread that is woken after a rest may take the processor from the one that woke it, which is culling. Where the
// system knows threads that do not, the calling thread is one from now on.
void giveWayToOthers() {
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
    giveWayToOthers();
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

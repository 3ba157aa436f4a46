// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TaskBoard.h"

#include "Interruption.h"

#include <chrono>
namespace osgbindem {

using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

std::optional<Task> TaskBoard::next() {
    constexpr std::chrono::milliseconds kGlance{50};  // at whether the user wants to stop
    std::unique_lock<std::mutex> guard(_mutex);
    while (!_error && (_isHeld || !isDone())) {
        throwIfStopRequested();
        while (_next < _tasks.size()) {
            const Task& task = _tasks[_next++];
            if (_claim && !_claim(task)) continue;
            ++_busy;
            return task;
        }
        _changed.wait_for(guard, kGlance);
    }
    return std::nullopt;
}

void TaskBoard::finish() {
    const std::lock_guard<std::mutex> guard(_mutex);
    --_busy;
    _changed.notify_all();
}

void TaskBoard::release() {
    const std::lock_guard<std::mutex> guard(_mutex);
    _isHeld = false;
    _changed.notify_all();
}

void TaskBoard::fail(std::exception_ptr error) {
    const std::lock_guard<std::mutex> guard(_mutex);
    if (!_error) _error = std::move(error);
    stopRequested.store(true);  // the other threads need not go on
    _changed.notify_all();
}

bool TaskBoard::isFinished() const {
    const std::lock_guard<std::mutex> guard(_mutex);
    return isDone();
}

bool TaskBoard::hasFailed() const {
    const std::lock_guard<std::mutex> guard(_mutex);
    return _error != nullptr;
}

void TaskBoard::rethrow() const {
    const std::lock_guard<std::mutex> guard(_mutex);
    if (_error) std::rethrow_exception(_error);
}

}  // namespace osgbindem

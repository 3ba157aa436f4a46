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
    while (!isOver()) {
        throwIfStopRequested();
        if (_next < _tasks.size()) return _tasks[_next++];
        _changed.wait_for(guard, kGlance);
    }
    return std::nullopt;
}

std::optional<Task> TaskBoard::take() {
    const std::lock_guard<std::mutex> guard(_mutex);
    if (isOver() || _next == _tasks.size()) return std::nullopt;
    return _tasks[_next++];
}

void TaskBoard::finish(const Task&) {
    const std::lock_guard<std::mutex> guard(_mutex);
    ++_finished;
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
    return _finished == _tasks.size();
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

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "WorkPlan.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

namespace osgbindem {

/// Hands tasks to the threads of a program.
class TaskSource {
public:
    virtual ~TaskSource() = default;

    /// Waits for a task. Returns: nullopt when all are finished, or one has failed. Throws Interrupted.
    [[nodiscard]] virtual std::optional<Task> next() = 0;
    /// The record of the task is there.
    virtual void finish(const Task& task) = 0;
    /// Stops all threads. Only the first error counts.
    virtual void fail(std::exception_ptr error) = 0;
};

/// The tasks of the plan and what has become of them.
class TaskBoard final : public TaskSource {
public:
    explicit TaskBoard(std::vector<Task> tasks) : _tasks(std::move(tasks)) {}

    [[nodiscard]] std::optional<Task> next() override;
    void finish(const Task& task) override;
    void fail(std::exception_ptr error) override;

    /// As next(), without waiting: nullopt when none is left that nobody has begun.
    [[nodiscard]] std::optional<Task> take();

    [[nodiscard]] bool isFinished() const;
    [[nodiscard]] bool hasFailed() const;
    /// Throws what made the threads stop.
    void rethrow() const;

private:
    [[nodiscard]] bool isOver() const { return _error || _finished == _tasks.size(); }

    mutable std::mutex _mutex;
    std::condition_variable _changed;
    const std::vector<Task> _tasks;
    std::size_t _next = 0;
    std::size_t _finished = 0;
    std::exception_ptr _error;
};

}  // namespace osgbindem

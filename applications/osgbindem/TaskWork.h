// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BuildState.h"
#include "Progress.h"
#include "Settings.h"
#include "TileBuilder.h"
#include "TileFiles.h"
#include "WorkPlan.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace osgbindem {

/// The tasks of the plan, for the threads of a program, and what has become of them.
class TaskBoard final {
public:
    explicit TaskBoard(std::vector<Task> tasks) : _tasks(std::move(tasks)) {}

    /// Waits for a task. Returns: nullopt when all are finished, or one has failed. Throws Interrupted.
    [[nodiscard]] std::optional<Task> next();
    /// The record of a task is there.
    void finish();
    /// Stops all threads. Only the first error counts.
    void fail(std::exception_ptr error);

    /// Threads that find no task left wait until release(): other programs are not done yet.
    void hold() { _isHeld = true; }
    void release();

    /// Whether nothing is left for this program to do.
    [[nodiscard]] bool isFinished() const;
    [[nodiscard]] bool hasFailed() const;
    /// Throws what made the threads stop.
    void rethrow() const;

private:
    [[nodiscard]] bool isDone() const { return _next == _tasks.size() && _busy == 0; }

    mutable std::mutex _mutex;
    std::condition_variable _changed;
    const std::vector<Task> _tasks;
    std::size_t _next = 0;
    int _busy = 0;
    bool _isHeld = false;
    std::exception_ptr _error;
};

/// What the threads share that build one database.
struct Site {
    const Settings& settings;
    const TileLayout& layout;
    const TileFiles& files;
    const BuildState& state;
    Progress& progress;
};

/// Does tasks as long as there are some, those left out that an earlier run has done and whose files are whole.
void doTasks(const Site& site, TaskBoard& tasks, TileBuilder& builder);

/// Finds what tasks have left. Requires: they are finished. Finding throws Failure when their records are gone.
[[nodiscard]] FinishedTasks finishedTasks(const Site& site, const std::vector<Task>& tasks);

/// Threads with one body, whose errors go to the board of their tasks.
class Threads final {
public:
    Threads(int count, TaskBoard& tasks, const std::function<void()>& body);
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
    ~Threads() { join(); }

    [[nodiscard]] bool areRunning() const { return _running > 0; }
    void join();

private:
    std::atomic<int> _running;
    std::vector<std::thread> _threads;
};

}  // namespace osgbindem

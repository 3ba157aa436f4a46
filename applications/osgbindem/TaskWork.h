// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BuildState.h"
#include "Progress.h"
#include "Settings.h"
#include "TaskBoard.h"
#include "TileBuilder.h"
#include "TileFiles.h"

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace osgbindem {

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

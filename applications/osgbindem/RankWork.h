// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Ranks.h"
#include "Settings.h"
#include "TaskWork.h"

#include <functional>

namespace osgbindem {

/// The three times at which all ranks wait for each other: when the first one has prepared the folder, when all parts
/// are done, and when the first one has completed the database. Those that are left are held when the object goes.
class Meetings final {
public:
    explicit Meetings(const Ranks& ranks) : _ranks(ranks) {}
    Meetings(const Meetings&) = delete;
    Meetings& operator=(const Meetings&) = delete;
    ~Meetings();

    /// The next one. `glance` is called while this rank waits.
    /// Throws: when a rank has failed, what it says in the first rank (Failure), Interrupted in the others.
    void hold(const std::function<void()>& glance);
    /// This rank has failed: returns when no other one writes any more.
    void giveUp();

private:
    const Ranks& _ranks;
    int _held = 0;
};

/// Waits while `isBusy`; stops the threads when another rank has failed. `interrupted` is called when a signal came,
/// and must not return.
void watchOthers(const Ranks& ranks, TaskBoard& board, const std::function<bool()>& isBusy,
                 const std::function<void()>& interrupted);

/// Every rank but the first: does parts of the plan until none is left. Errors are told to the first alone.
void helpFirstRank(const Settings& settings, const Ranks& ranks);

}  // namespace osgbindem

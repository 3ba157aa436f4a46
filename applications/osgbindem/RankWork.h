// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Ranks.h"
#include "TaskWork.h"

namespace osgbindem {

/// Rank 0: hands tasks to the other ranks and notes what became of them, until all have said that they are done and the
/// threads of this one have ended. `interrupted` is called when a signal came, and must not return.
/// Returns: how many ranks are done.
int serveRanks(const Ranks& ranks, const Threads& threads, TaskBoard& board, Progress& progress,
               const std::function<void()>& interrupted);

/// Every other rank: does what rank 0 hands out, until there is no more. Errors are told to rank 0 alone.
void workForFirstRank(const Settings& settings, const Ranks& ranks);

}  // namespace osgbindem

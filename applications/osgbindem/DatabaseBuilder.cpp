// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"
#include "BuildState.h"
#include "Database.h"
#include "DatabaseFolder.h"
#include "Failure.h"
#include "Interruption.h"
#include "NodeFile.h"
#include "RankWork.h"
#include "StartTiles.h"
#include "TaskWork.h"
#include "WorkPlan.h"

#include <iostream>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

/// Says what an earlier run has left, and makes the state one of this database.
void beginOrGoOn(const Settings& settings, const std::string& sources, std::size_t parts, DatabaseFolder& folder,
                 const BuildState& state) {
    const bool isSame = state.isOf(sources);
    const std::size_t done = state.count();
    if (isSame && !settings.restart) {
        if (done > 0 && !settings.quiet) {
            std::cout << "resumes: " << done << " of " << parts << " parts are done" << std::endl;
        }
        return;
    }
    if (done > 0 && !settings.quiet) {
        std::cout << "starts again: \"" << folder.partial() << "\" was "
                  << (isSame ? "to be removed" : "built from other settings or rasters") << std::endl;
    }
    folder.clear();
    state.begin(sources);
}

/// For the user, after a message; empty when nothing is kept.
std::string whatIsKept(const DatabaseFolder& folder, const BuildState& state, std::size_t parts) {
    const std::size_t done = state.count();
    if (done == 0) return {};
    return std::to_string(done) + " of " + std::to_string(parts) + " parts are kept in \"" + folder.partial() +
           "\"; the same command goes on with them";
}

std::string interruption(const DatabaseFolder& folder, const BuildState& state, std::size_t parts) {
    const std::string kept = whatIsKept(folder, state, parts);
    return "interrupted; " + (kept.empty() ? "nothing was left behind" : kept);
}

void buildParts(const Site& site, const std::vector<Task>& plan, const std::string& sources, DatabaseFolder& folder,
                const Ranks& ranks, Meetings& meetings) {
    // What another rank has begun counts as done: nobody else says how far it is.
    const auto claim = [&site](const Task& task) {
        if (site.state.claim(task.tile)) return true;
        site.progress.add(task.weight);
        return false;
    };
    TaskBoard board(plan, ranks.count() > 1 ? TaskBoard::Claim(claim) : TaskBoard::Claim());
    if (ranks.count() > 1) board.hold();
    StartTiles starts(site.settings, site.layout);
    const FinishedTasks finished = finishedTasks(site, plan);
    Threads threads(site.settings.threads, board, [&] {
        TileBuilder builder(site.settings, site.layout, site.files);
        doTasks(site, board, builder);
        if (board.hasFailed()) return;
        builder.setFinishedTasks(finished);
        starts.build(builder);
    });
    if (ranks.count() > 1) {
        const auto interrupted = [&] {
            // Others may be writing still, and mpirun has no patience: all is left as it is, as after a kill.
            std::cerr << "osgbindem: " + interruption(folder, site.state, plan.size()) + "\n" << std::flush;
            Ranks::leaveAfterSignal();
        };
        watchOthers(
            ranks, board, [&] { return threads.areRunning() && !board.isFinished(); }, interrupted);
        try {
            if (!board.hasFailed())
                meetings.hold([&] {
                    if (stopRequested) interrupted();
                });
            board.release();
        } catch (...) {
            board.fail(std::current_exception());
        }
    }
    threads.join();
    if (board.hasFailed()) {
        ranks.sendFailure({});
        meetings.giveUp();
    }
    board.rethrow();
    folder.complete(starts.rootBytes(), sources);
}

void buildWith(const Settings& settings, const Ranks& ranks, Meetings& meetings) {
    prepareNodeFiles();
    const TileLayout layout = checkedLayoutFor(settings);
    DatabaseFolder folder(settings.output);
    folder.lock();
    if (!settings.overwrite) folder.requireNone();
    const BuildState state(folder.stateFolder());
    const std::vector<Task> plan = planTasks(settings, layout);
    const std::string sources = describeSources(settings, layout);
    beginOrGoOn(settings, sources, plan.size(), folder, state);
    if (ranks.count() > 1) state.forgetClaims();
    meetings.hold([] { throwIfStopRequested(); });
    try {
        const TileFiles files = folder.files(layout);
        Progress progress(!settings.quiet, weightOf(plan));
        buildParts({settings, layout, files, state, progress}, plan, sources, folder, ranks, meetings);
        progress.finish();
    } catch (const Interrupted&) {
        throw Interrupted(interruption(folder, state, plan.size()));
    } catch (const Failure& failure) {
        const std::string kept = whatIsKept(folder, state, plan.size());
        throw Failure(failure.what() + (kept.empty() ? kept : "; " + kept));
    }
}

}  // namespace

void buildDatabase(const Settings& settings, const Ranks& ranks) {
    if (!ranks.isFirst()) return helpFirstRank(settings, ranks);
    Meetings meetings(ranks);
    buildWith(settings, ranks, meetings);
}

}  // namespace osgbindem

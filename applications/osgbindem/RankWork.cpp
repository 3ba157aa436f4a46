// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RankWork.h"

#include "DatabaseFolder.h"
#include "DiskFile.h"
#include "Failure.h"
#include "Interruption.h"
#include "NodeFile.h"
#include "TaskWork.h"
#include "WorkPlan.h"

#include <exception>
#include <new>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;

namespace {

std::exception_ptr failureOf(const Ranks& ranks, const std::string& text) {
    return ranks.isFirst() ? std::make_exception_ptr(Failure(text)) : std::make_exception_ptr(Interrupted());
}

void leaveIfStopped() {
    if (stopRequested) Ranks::leaveAfterSignal();
}

void work(const Settings& settings, const Ranks& ranks, Meetings& meetings) {
    prepareNodeFiles();
    const TileLayout layout = layoutFor(settings, DemMosaic(settings));
    const std::vector<Task> plan = planTasks(settings, layout);
    meetings.hold(leaveIfStopped);
    const DatabaseFolder folder(settings.output);
    const TileFiles files = folder.files(layout);
    const BuildState state(folder.stateFolder());
    Progress progress(false, 1.0);
    const Site site{settings, layout, files, state, progress};
    TaskBoard board(plan, [&state](const Task& task) { return state.claim(task.tile); });
    Threads threads(settings.threads, board, [&] {
        TileBuilder builder(settings, layout, files);
        doTasks(site, board, builder);
    });
    watchOthers(
        ranks, board, [&] { return threads.areRunning(); }, Ranks::leaveAfterSignal);
    threads.join();
    board.rethrow();
    osgAnalyticBin::support::flushToDisk(folder.partial());  // what this machine holds back of it
    meetings.hold(leaveIfStopped);
}

}  // namespace

Meetings::~Meetings() {
    giveUp();
    (void)_ranks.meet(false, {});
}

void Meetings::giveUp() {
    constexpr int kUntilPartsAreDone = 2;
    for (; _held < kUntilPartsAreDone; ++_held) (void)_ranks.meet(true, {});
}

void Meetings::hold(const std::function<void()>& glance) {
    ++_held;
    if (!_ranks.meet(false, glance)) return;
    // It was sent before that rank came.
    std::optional<std::string> text;
    while (_ranks.isFirst() && !(text = _ranks.failureElsewhere())) waitABit();
    std::rethrow_exception(failureOf(_ranks, text.value_or("")));
}

void watchOthers(const Ranks& ranks, TaskBoard& board, const std::function<bool()>& isBusy,
                 const std::function<void()>& interrupted) {
    for (; isBusy(); waitABit()) {
        if (stopRequested && !board.hasFailed()) interrupted();
        if (const auto text = ranks.failureElsewhere()) board.fail(failureOf(ranks, *text));
    }
}

void helpFirstRank(const Settings& settings, const Ranks& ranks) {
    Meetings meetings(ranks);
    try {
        work(settings, ranks, meetings);
    } catch (const Interrupted&) {
        // the first rank knows why
    } catch (const std::bad_alloc&) {
        ranks.sendFailure("out of memory; use fewer ranks or --threads on a machine");
    } catch (const std::exception& error) {
        ranks.sendFailure(error.what());
    }
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TaskWork.h"

#include "Failure.h"

#include <cmath>
#include <exception>
#include <set>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// Does a task, unless an earlier run has done it and its files are whole.
void doTask(const Task& task, const Site& site, TileBuilder& builder) {
    const auto known = site.state.find(task.tile, site.layout);
    if (known && known->files == site.files.sumBelow(task.tile)) {
        site.progress.addKnown(task.weight);
        return;
    }
    builder.setLeafDone(
        [&](const TileId& leaf) { site.progress.add(std::ldexp(task.weight, 2 * (task.tile.level - leaf.level))); });
    (void)builder.takeFileSum();
    SurveyedTile tile = builder.survey(task.tile);
    site.state.keep({std::move(tile), builder.takeFileSum()});
}

}  // namespace

void doTasks(const Site& site, TaskBoard& tasks, TileBuilder& builder) {
    while (const auto task = tasks.next()) {
        doTask(*task, site, builder);
        tasks.finish();
    }
    builder.setLeafDone({});
}

FinishedTasks finishedTasks(const Site& site, const std::vector<Task>& tasks) {
    std::set<TileId> tiles;
    for (const Task& task : tasks) tiles.insert(task.tile);
    return [&site, tiles](const TileId& tile) -> std::optional<SurveyedTile> {
        if (tiles.count(tile) == 0) return std::nullopt;
        auto record = site.state.find(tile, site.layout);
        if (!record) throw Failure("what was done of tile " + tileName(tile) + " is gone; run the same command again");
        return std::move(record->tile);
    };
}

Threads::Threads(int count, TaskBoard& tasks, const std::function<void()>& body) : _running(count) {
    for (int i = 0; i < count; ++i) {
        _threads.emplace_back([this, &tasks, body] {
            try {
                body();
            } catch (...) {
                tasks.fail(std::current_exception());
            }
            --_running;
        });
    }
}

void Threads::join() {
    for (std::thread& thread : _threads) {
        if (thread.joinable()) thread.join();
    }
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TaskWork.h"

#include "Failure.h"
#include "Interruption.h"

#include <ogr_srs_api.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
#include <iostream>
#include <optional>
#include <set>
#include <thread>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::stopRequested;

namespace {

// A whole globe without insets is just below: 128 tasks, one for each start tile.
constexpr double kFewestTasks = 100.0;
// Half a minute's work: as much is lost in each thread when a run is ended, and waited for at its end.
constexpr double kMostWeight = 4096.0;

Task taskFor(const TileId& tile, const DemMosaic& mosaic, const TileLayout& layout) {
    return {tile, 1.0 + mosaic.posts(tile.rect()) / (static_cast<double>(layout.cells()) * layout.cells())};
}

/// In voids, tasks may be of tiles that are not there; nobody asks for what they leave.
void split(const Task& task, double most, const DemMosaic& mosaic, const TileLayout& layout, std::vector<Task>& tasks) {
    const TileId& tile = task.tile;
    if (task.weight <= most || tile.level >= layout.deepestLevel() || !layout.isInRegion(tile) ||
        !mosaic.hasFinerRaster(tile.rect(), layout.spacingDeg(tile.level))) {
        tasks.push_back(task);
        return;
    }
    for (const TileId& child : tile.children()) split(taskFor(child, mosaic, layout), most, mosaic, layout, tasks);
}

/// Does a task, unless an earlier run has done it and its files are whole.
void doTask(const Task& task, const Site& site, TileBuilder& builder) {
    const auto known = site.folder.find(task.tile, site.layout);
    if (known && known->checksum == site.files.checksumBelow(task.tile)) {
        site.progress.add(task.weight, true);
        return;
    }
    double left = task.weight;
    builder.setLeafDone([&](const TileId& leaf) {
        const double share = std::ldexp(task.weight, 2 * (task.tile.level - leaf.level));
        left -= share;
        site.progress.add(share);
    });
    site.folder.keep(builder.survey(task.tile));
    builder.setLeafDone({});
    site.progress.add(left);
}

using Work = std::function<void(TileBuilder& builder)>;

/// Does `work` in each thread with a builder of its own.
void inThreads(const Site& site, const Glance& glance, const Work& work) {
    std::mutex mutex;
    std::exception_ptr error;
    std::atomic<bool> hasFailed{false};
    const auto guarded = [&](const auto& act) {
        try {
            act();
        } catch (...) {
            const std::lock_guard<std::mutex> guard(mutex);
            if (!error) error = std::current_exception();
            hasFailed.store(true);
            stopRequested.store(true);  // the other threads need not go on
        }
    };
    // GDAL hands transformations on from thread to thread, and those of rotated poles keep PROJ's context of the thread
    // that made them. So all threads wait until the last one has finished, and delete these transformations.
    std::atomic<std::size_t> finished{0};
    std::vector<std::future<void>> threads;
    std::promise<void> leave;
    const std::shared_future<void> mayLeave = leave.get_future().share();
    for (int i = 0; i < site.settings.threads.value_or(1); ++i) {
        threads.push_back(std::async(std::launch::async, [&, mayLeave] {
            guarded([&] {
                TileBuilder builder(site.settings, site.layout, site.files);
                if (site.standing)
                    builder.setFinishedTasks([&](const TileId& tile) { return site.standing(builder, tile); });
                work(builder);
            });
            ++finished;
            mayLeave.wait();
            OSRCleanup();
        }));
    }
    for (; finished < threads.size(); std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
        const bool isStopped = stopRequested;  // before the look at failures, which set it too
        if (glance && !hasFailed) guarded([&] { glance(isStopped); });
    }
    leave.set_value();
    for (const auto& thread : threads) thread.wait();
    if (error) std::rethrow_exception(error);
}

}  // namespace

TileLayout layoutFor(const Settings& settings, const DemMosaic& mosaic) {
    const int cells = settings.cells.value_or(TileLayout::cellsFor(mosaic.finestGlobalDeg()));
    const int levels = settings.levels.value_or(TileLayout::levelFor(mosaic.finestDeg(), cells));
    return TileLayout(cells, levels, settings.ellipsoid, settings.region);
}

TileLayout checkedLayoutFor(const Settings& settings) {
    DemMosaic mosaic(settings);
    for (const std::string& line : mosaic.inspect()) {
        if (!settings.quiet) std::cout << line << std::endl;
    }
    if (settings.region && !(mosaic.posts(*settings.region) > 0.0)) {
        throw Failure("no raster has a part within -te; give degrees as WEST SOUTH EAST NORTH");
    }
    return layoutFor(settings, mosaic);
}

double weightOf(const std::vector<Task>& tasks) {
    double sum = 0.0;
    for (const Task& task : tasks) sum += task.weight;
    return sum;
}

std::vector<Task> planTasks(const DemMosaic& mosaic, const TileLayout& layout) {
    std::vector<Task> starts;
    double sum = 0.0;
    for (const TileId& tile : layout.startTiles()) {
        starts.push_back(taskFor(tile, mosaic, layout));
        sum += starts.back().weight;
    }
    std::vector<Task> tasks;
    const double most = std::min(sum / kFewestTasks, kMostWeight);
    for (const Task& start : starts) split(start, most, mosaic, layout, tasks);
    return tasks;
}

void doTasks(const Site& site, const std::vector<Task>& tasks, const Glance& glance) {
    std::atomic<std::size_t> next{0};
    inThreads(site, glance, [&](TileBuilder& builder) {
        for (std::size_t i = next++; i < tasks.size(); i = next++) doTask(tasks[i], site, builder);
    });
}

std::vector<BuiltTile> buildStarts(const Site& site, const std::vector<Task>& plan) {
    std::set<TileId> done;
    for (const Task& task : plan) done.insert(task.tile);
    const std::vector<TileId>& tiles = site.layout.startTiles();
    std::vector<BuiltTile> starts(tiles.size());
    std::atomic<std::size_t> next{0};
    inThreads(site, nullptr, [&](TileBuilder& builder) {
        builder.setFinishedTasks([&](const TileId& tile) {
            if (done.count(tile) == 0) return site.standing ? site.standing(builder, tile) : std::nullopt;
            auto record = site.folder.find(tile, site.layout);
            if (!record) throw Failure("what was done of tile " + tileName(tile) + " is gone; run the command again");
            return record;
        });
        for (std::size_t i = next++; i < tiles.size(); i = next++) starts[i] = builder.build(tiles[i]);
    });
    return starts;
}

}  // namespace osgbindem

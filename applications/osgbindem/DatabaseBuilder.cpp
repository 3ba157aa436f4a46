// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"

#include "Failure.h"
#include "RasterFile.h"
#include "TextFile.h"

#include <cpl_string.h>
#include <ogr_srs_api.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
#include <iostream>
#include <set>

namespace osgbindem {

using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

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

/// What the threads share that build one database.
struct Site {
    const Settings& settings;
    const TileLayout& layout;
    const DatabaseFolder& folder;
    Progress& progress;
};

/// Does a task, unless an earlier run has done it and its files are whole.
void doTask(const Task& task, const Site& site, TileBuilder& builder) {
    const auto known = site.folder.find(task.tile, site.layout);
    if (known && known->checksum == site.folder.files().checksumBelow(task.tile)) {
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
void inThreads(const Site& site, const Work& work) {
    std::mutex mutex;
    std::exception_ptr error;
    // GDAL hands transformations on from thread to thread, and those of rotated poles keep PROJ's context of the thread
    // that made them. So all threads wait until the last one has finished, and delete these transformations.
    const auto count = static_cast<std::size_t>(site.settings.threads.value_or(1));
    std::size_t finished = 0;
    std::vector<std::future<void>> threads;
    std::promise<void> leave;
    const std::shared_future<void> mayLeave = leave.get_future().share();
    while (threads.size() < count) {
        threads.push_back(std::async(std::launch::async, [&, mayLeave] {
            std::exception_ptr thrown;
            try {
                TileBuilder builder(site.settings, site.layout, site.folder.files());
                work(builder);
            } catch (...) {
                thrown = std::current_exception();
                stopRequested.store(true);  // the other threads need not go on
            }
            {
                const std::lock_guard<std::mutex> guard(mutex);
                if (!error) error = thrown;
                if (++finished == count) leave.set_value();
            }
            mayLeave.wait();
            OSRCleanup();
        }));
    }
    for (const auto& thread : threads) thread.wait();
    if (error) std::rethrow_exception(error);
}

/// The layout that the settings ask for, or else the rasters.
TileLayout layoutFor(const Settings& settings, const DemMosaic& mosaic) {
    const int cells = settings.cells.value_or(TileLayout::cellsFor(mosaic.finestGlobalDeg()));
    const int levels = settings.levels.value_or(TileLayout::levelFor(mosaic.finestDeg(), cells));
    return TileLayout(cells, levels, settings.ellipsoid, settings.region);
}

/// The same, once every raster is known to have heights; the rasters are closed again. Says what the user should know
/// of them. Throws Failure.
TileLayout checkedLayoutFor(const Settings& settings) {
    DemMosaic mosaic(settings);
    for (const std::string& line : mosaic.inspect()) std::cout << line << std::endl;
    if (settings.region && !(mosaic.posts(*settings.region) > 0.0))
        throw Failure("no raster has a part within -te; give degrees as WEST SOUTH EAST NORTH");
    return layoutFor(settings, mosaic);
}

/// Divides the tree into subtrees of similar weight; neighbours follow each other. What lies above the subtrees is left
/// for afterwards. The plan is the same however many threads and programs share the work, so that others can go on.
/// No raster is read.
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

/// Does tasks in threads, those left out that an earlier run has done and whose files are whole.
/// Throws what was thrown first.
void doTasks(const Site& site, const std::vector<Task>& tasks) {
    std::atomic<std::size_t> next{0};
    inThreads(site, [&](TileBuilder& builder) {
        for (std::size_t i = next++; i < tasks.size(); i = next++) doTask(tasks[i], site, builder);
    });
}

/// Builds the start tiles in threads, from what all tasks of the plan have left. Throws what was thrown first.
std::vector<BuiltTile> buildStarts(const Site& site, const std::vector<Task>& plan) {
    std::set<TileId> done;
    for (const Task& task : plan) done.insert(task.tile);
    const std::vector<TileId>& tiles = site.layout.startTiles();
    std::vector<BuiltTile> starts(tiles.size());
    std::atomic<std::size_t> next{0};
    inThreads(site, [&](TileBuilder& builder) {
        builder.setFinishedTasks([&](const TileId& tile) {
            if (done.count(tile) == 0) return std::optional<SurveyedTile>();
            auto record = site.folder.find(tile, site.layout);
            if (!record) throw Failure("what was done of tile " + tileName(tile) + " is gone; run the command again");
            return record;
        });
        for (std::size_t i = next++; i < tiles.size(); i = next++) starts[i] = builder.build(tiles[i]);
    });
    return starts;
}

/// Says what an earlier run has left, and makes the state one of this database.
void beginOrGoOn(const std::string& sources, std::size_t parts, DatabaseFolder& folder) {
    const std::size_t done = folder.doneCount();
    if (folder.isStateOf(sources)) {
        if (done > 0) std::cout << "resumes: " << done << " of " << parts << " parts are done" << std::endl;
        return;
    }
    if (done > 0)
        std::cout << "starts again: \"" << folder.partial() << "\" was built from other settings or rasters"
                  << std::endl;
    folder.clear();
    folder.beginState(sources);
}

/// For the user, after a message; empty when nothing is kept.
std::string whatIsKept(const DatabaseFolder& folder, std::size_t parts) {
    const std::size_t done = folder.doneCount();
    if (done == 0) return {};
    return "; " + std::to_string(done) + " of " + std::to_string(parts) + " parts are kept in \"" + folder.partial() +
           "\"; the same command goes on with them";
}

/// Says what was built, in lines, and warns where data is missing. `seconds`: the time that it took.
void tell(const Tally& tally, const Interval& range, const std::string& name, int startLevel, double seconds) {
    std::cout << name
              << CPLSPrintf(": %.0f tiles in levels %d to %.0f, %.0f files, %.1f MiB, %.1f s", tally.tiles, startLevel,
                            tally.deepest, tally.files, std::ldexp(tally.bytes, -20), seconds);
    std::cout << CPLSPrintf(
                     "\nheights from %.1f to %.1f m; of %.0f posts, %.0f are filled voids and %.0f are at 0 m "
                     "without data",
                     range.lower, range.upper, tally.posts, tally.filled, tally.missing)
              << std::endl;
    if (tally.missing == 0.0) return;
    std::cerr << CPLSPrintf(
                     "osgbindem: warning: no raster has data for %.0f of %.0f posts, which are at 0 m; add a "
                     "raster below, or build a part of the earth with -te",
                     tally.missing, tally.posts)
              << std::endl;
}

/// Ranks take turns, so that each has as much to do as the others.
std::vector<Task> partsOf(const Ranks& ranks, const std::vector<Task>& plan) {
    std::vector<Task> parts;
    for (std::size_t i = static_cast<std::size_t>(ranks.rank()); i < plan.size();
         i += static_cast<std::size_t>(ranks.count()))
        parts.push_back(plan[i]);
    return parts;
}

/// What has changed since the finished database was built. Throws Failure when it cannot be brought up to date.
ChangedArea changesSince(const DatabaseFolder& folder, const std::string& sources, const std::string& name) {
    const std::string before = folder.standingSources();
    if (before.empty())
        throw Failure("nobody knows what \"" + name + "\" was built from; build it anew, with --overwrite");
    const auto area = changedBetween(before, sources);
    if (!area)
        throw Failure("\"" + name +
                      "\" was built with other settings or by another version; give the same, or build it anew, with "
                      "--overwrite");
    return *area;
}

void buildWith(const Settings& given, const Ranks& ranks) {
    const auto start = std::chrono::steady_clock::now();
    prepareNodeFiles();
    const Settings settings = withDeclaredRadii(given);
    const TileLayout layout = checkedLayoutFor(settings);
    DatabaseFolder folder(settings.output);
    folder.lock();
    if (!settings.overwrite && !settings.update) folder.requireNone();
    const std::vector<Task> plan = planTasks(DemMosaic(settings, &layout), layout);
    const std::string sources = describeSources(settings, layout);
    const bool isUpdate = settings.update && folder.isComplete();
    const ChangedArea area = isUpdate ? changesSince(folder, sources, settings.output) : ChangedArea();
    if (isUpdate && area.empty()) {
        std::cout << "nothing has changed in \"" << settings.output << "\"" << std::endl;
        ranks.meet(false, throwIfStopRequested);
        return;
    }
    beginOrGoOn(sources, plan.size(), folder);
    if (isUpdate) {
        const std::size_t unchanged = takeOverUnchanged(settings, layout, plan, area, folder);
        std::cout << "updates: " << unchanged << " of " << plan.size() << " parts stay" << std::endl;
    }
    ranks.meet(true, throwIfStopRequested);  // the folder is ready
    try {
        Progress progress(!settings.quiet, partsOf(ranks, plan));
        const Site site{settings, layout, folder, progress};
        doTasks(site, partsOf(ranks, plan));
        ranks.meet(true, throwIfStopRequested);  // all parts are done
        const std::vector<BuiltTile> starts = buildStarts(site, plan);
        const std::string root = rootFileBytes(starts, settings, layout);
        folder.complete(root);
        progress.finish();
        if (settings.quiet) return;
        Tally tally;
        Interval range = Interval::none();
        for (const BuiltTile& tile : starts) {
            tally.add(tile.survey.tally);
            range = range.united(tile.survey.range);
        }
        ++tally.files;
        tally.bytes += static_cast<double>(root.size());
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        tell(tally, range, settings.output, layout.startLevel(), time.count());
    } catch (const Interrupted&) {
        throw Interrupted("interrupted" + whatIsKept(folder, plan.size()));
    } catch (const Failure& failure) {
        throw Failure(failure.what() + whatIsKept(folder, plan.size()));
    }
}

/// Every rank but the first.
void helpFirstRank(const Settings& given, const Ranks& ranks) {
    Settings settings = given;
    std::optional<TileLayout> layout;
    std::vector<Task> plan;
    std::exception_ptr error;
    try {
        prepareNodeFiles();
        settings = withDeclaredRadii(given);
        layout = layoutFor(settings, DemMosaic(settings));
        plan = planTasks(DemMosaic(settings, &*layout), *layout);
    } catch (...) {
        error = std::current_exception();  // as a rule the first rank has found the same, and ends all
    }
    if (!ranks.meet(true, throwIfStopRequested)) return;
    if (error) std::rethrow_exception(error);
    const DatabaseFolder folder(settings.output);
    Progress progress(false, plan);
    doTasks({settings, *layout, folder, progress}, partsOf(ranks, plan));
    osgAnalyticBin::support::flushToDisk(folder.partial());  // what this machine holds back
    ranks.meet(true, throwIfStopRequested);
}

}  // namespace

void buildDatabase(const Settings& settings, const Ranks& ranks) {
    ranks.isFirst() ? buildWith(settings, ranks) : helpFirstRank(settings, ranks);
}

}  // namespace osgbindem

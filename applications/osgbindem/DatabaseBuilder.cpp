// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"

#include "BuildSources.h"
#include "BuildState.h"
#include "DatabaseFolder.h"
#include "Failure.h"
#include "Interruption.h"
#include "NodeFile.h"
#include "Progress.h"
#include "RootNode.h"
#include "TaskBoard.h"
#include "TileBuilder.h"
#include "WorkPlan.h"

#include <atomic>
#include <cmath>
#include <exception>
#include <iostream>
#include <set>
#include <thread>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::Interrupted;

namespace {

constexpr std::size_t kStartTiles = std::size_t{TileId::kStartColumns} * TileId::kStartRows;

/// What the threads share that build one database.
struct Site {
    const Settings& settings;
    const TileLayout& layout;
    const TileFiles& files;
    const BuildState& state;
    Progress& progress;
};

/// Does a task, unless an earlier run has done it and its files are whole.
void doTask(const Task& task, const Site& site, TileBuilder& builder) {
    const auto known = site.state.find(task.tile, site.layout);
    if (known && known->files == site.files.sumBelow(task.tile)) {
        site.progress.add(task.weight);
        return;
    }
    builder.setLeafDone(
        [&](const TileId& leaf) { site.progress.add(std::ldexp(task.weight, 2 * (task.tile.level - leaf.level))); });
    (void)builder.takeFileSum();
    SurveyedTile tile = builder.survey(task.tile);
    site.state.keep({std::move(tile), builder.takeFileSum()});
}

void doTasks(const Site& site, TaskSource& tasks, TileBuilder& builder) {
    while (const auto task = tasks.next()) {
        doTask(*task, site, builder);
        tasks.finish(*task);
    }
    builder.setLeafDone({});
}

/// The start tiles, made of what the tasks have left of the tiles below them.
class StartTiles {
public:
    StartTiles(const Site& site, const std::vector<Task>& tasks) : _site(site) {
        for (const Task& task : tasks) _tasks.insert(task.tile);
    }

    /// Requires: all tasks are finished. May be called by several threads; they share the tiles.
    void build(TileBuilder& builder) {
        builder.setFinishedTasks([this](const TileId& tile) { return finished(tile); });
        for (std::size_t i = _next++; i < kStartTiles; i = _next++) {
            const int place = static_cast<int>(i);
            _tiles[i] = builder.build({0, place % TileId::kStartColumns, place / TileId::kStartColumns});
        }
    }

    /// Requires: all are built. The bytes of the root file.
    [[nodiscard]] std::string rootBytes(TileBuilder& builder) const {
        const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_site.settings);
        std::vector<osg::Geometry*> geometries;
        for (const auto& tile : _tiles) {
            root->addChild(tile->node);
            geometries.push_back(tile->geometry);
        }
        builder.finishFile(geometries, 0);
        declareHorizon(*root);
        return nodeFileBytes(*root, _site.settings.compress);
    }

private:
    [[nodiscard]] std::optional<SurveyedTile> finished(const TileId& tile) const {
        if (_tasks.count(tile) == 0) return std::nullopt;
        auto record = _site.state.find(tile, _site.layout);
        if (!record) throw Failure("what was done of tile " + tileName(tile) + " is gone; run the same command again");
        return std::move(record->tile);
    }

    const Site& _site;
    std::set<TileId> _tasks;
    std::array<std::unique_ptr<BuiltTile>, kStartTiles> _tiles;
    std::atomic<std::size_t> _next{0};
};

/// Says what an earlier run has left, and makes the state one of this database.
void beginOrGoOn(const Settings& settings, const std::string& sources, std::size_t parts, DatabaseFolder& folder,
                 const BuildState& state) {
    const bool isSame = state.isOf(sources);
    const std::size_t done = state.count();
    if (isSame && !settings.restart) {
        if (done > 0 && !settings.quiet) {
            std::cout << "goes on: " << done << " of " << parts << " parts are there" << std::endl;
        }
        return;
    }
    if (done > 0 && !settings.quiet) {
        std::cout << "starts anew: \"" << folder.partial() << "\" was "
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

void buildParts(const Settings& settings, const Site& site, const std::vector<Task>& plan, DatabaseFolder& folder,
                const std::string& sources) {
    TaskBoard board(plan);
    StartTiles starts(site, plan);
    runThreads(settings.threads, board, [&] {
        TileBuilder builder(settings, site.layout, site.files);
        doTasks(site, board, builder);
        if (board.isFinished()) starts.build(builder);
    });
    board.rethrow();
    TileBuilder builder(settings, site.layout, site.files);
    folder.complete(starts.rootBytes(builder), sources);
}

}  // namespace

void buildDatabase(const Settings& settings) {
    prepareNodeFiles();
    DemMosaic mosaic(settings);
    mosaic.requireData();
    const TileLayout layout = planLayout(settings, mosaic);
    DatabaseFolder folder(settings.output);
    folder.lock();
    const BuildState state(folder.stateFolder());
    DemMosaic built(settings, layout.spacingDeg(layout.deepestLevel()));
    EdgeDepths depths(built, layout);
    const std::vector<Task> plan = planTasks(built, depths, layout);
    const std::string sources = describeSources(settings, layout);
    beginOrGoOn(settings, sources, plan.size(), folder, state);
    try {
        const TileFiles files = folder.files();
        Progress progress(!settings.quiet, weightOf(plan));
        buildParts(settings, {settings, layout, files, state, progress}, plan, folder, sources);
        progress.finish();
    } catch (const Interrupted&) {
        const std::string kept = whatIsKept(folder, state, plan.size());
        throw Interrupted("interrupted; " + (kept.empty() ? "nothing was left behind" : kept));
    } catch (const Failure& failure) {
        const std::string kept = whatIsKept(folder, state, plan.size());
        throw Failure(failure.what() + (kept.empty() ? kept : "; " + kept));
    }
}

}  // namespace osgbindem

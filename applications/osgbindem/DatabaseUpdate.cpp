// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseUpdate.h"

#include "BuildSources.h"
#include "ChangedArea.h"
#include "DatabaseFolder.h"
#include "Failure.h"
#include "NodeFile.h"
#include "Progress.h"
#include "StandingDatabase.h"
#include "StartTiles.h"
#include "TaskBoard.h"
#include "TaskWork.h"
#include "TileBuilder.h"
#include "WorkPlan.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <mutex>
#include <set>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// What the threads have found out.
class Findings {
public:
    void keep(SurveyedTile tile) {
        const std::lock_guard<std::mutex> guard(_mutex);
        const TileId id = tile.heights.tile();
        _surveyed.emplace(id, std::move(tile));
    }
    [[nodiscard]] std::optional<SurveyedTile> find(const TileId& tile) const {
        const std::lock_guard<std::mutex> guard(_mutex);
        const auto found = _surveyed.find(tile);
        return found == _surveyed.end() ? std::nullopt : std::optional(found->second);
    }
    void removeChildren(const TileId& tile) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _removed.insert(tile);
    }
    /// Requires: the threads have ended.
    [[nodiscard]] std::vector<TileId> removed() const { return {_removed.begin(), _removed.end()}; }

private:
    mutable std::mutex _mutex;
    std::map<TileId, SurveyedTile> _surveyed;
    std::set<TileId> _removed;
};

/// One thread's way through the tiles: builds those that change, takes the others from the database.
class Updater {
public:
    Updater(const Settings& settings, const TileLayout& layout, const StandingDatabase& standing,
            const TileFiles& files, const ChangedArea& area, Findings& findings)
        : _builder(settings, layout, files),
          _standing(standing),
          _changed(area, _builder.depths(), layout, [this](const TileId& tile) { return _standing.hasChildren(tile); }),
          _findings(findings) {
        _builder.setFinishedTasks([this](const TileId& tile) { return known(tile); });
    }
    Updater(const Updater&) = delete;
    Updater& operator=(const Updater&) = delete;

    [[nodiscard]] TileBuilder& builder() noexcept { return _builder; }
    [[nodiscard]] bool hasChanged(const TileId& tile) const { return _changed.has(tile); }

    void update(const Task& task, Progress& progress) {
        _findings.keep(_builder.survey(task.tile));
        progress.add(task.weight);
    }

private:
    std::optional<SurveyedTile> known(const TileId& tile) {
        if (auto found = _findings.find(tile)) return found;
        const bool hasChildren = _builder.depths().hasChildren(tile);
        if (!hasChildren) removeBelow(tile);
        if (!hasChildren || _changed.has(tile)) return std::nullopt;
        return standing(tile);
    }

    void removeBelow(const TileId& tile) {
        if (!_standing.hasChildren(tile)) return;
        _findings.removeChildren(tile);
        for (const TileId& child : tile.children()) removeBelow(child);
    }

    /// A tile with everything below it as it is; the bin of a tile holds whatever is below.
    SurveyedTile standing(const TileId& tile) {
        SurveyedTile surveyed = _builder.surveyAlone(tile);
        surveyed.below = _standing.bin(tile);
        surveyed.range = {surveyed.below.bin().altitude().lower, surveyed.below.bin().altitude().upper};
        return surveyed;
    }

    TileBuilder _builder;
    StandingDatabase _standing;
    ChangedTiles _changed;
    Findings& _findings;
};

std::vector<Task> changedTasks(Updater updater, const TileLayout& layout) {
    std::vector<Task> tasks = planTasks(updater.builder().mosaic(), updater.builder().depths(), layout);
    tasks.erase(
        std::remove_if(tasks.begin(), tasks.end(), [&](const Task& task) { return !updater.hasChanged(task.tile); }),
        tasks.end());
    return tasks;
}

ChangedArea requireUpdatable(const DatabaseFolder& folder, const std::string& sources) {
    const std::string before = folder.standingSources();
    if (before.empty()) {
        throw Failure("no database \"" + folder.rootFile() +
                      "\" of which it is known what it was built from; build it without --update");
    }
    const auto area = changedBetween(before, sources);
    if (!area) {
        throw Failure("\"" + folder.rootFile() +
                      "\" was built with other settings or by another version; give the same, or build it anew "
                      "without --update");
    }
    return *area;
}

}  // namespace

void updateDatabase(const Settings& settings) {
    prepareNodeFiles();
    const TileLayout layout = checkedLayoutFor(settings);
    DatabaseFolder folder(settings.output);
    folder.lock();
    const std::string sources = describeSources(settings, layout);
    const ChangedArea area = requireUpdatable(folder, sources);
    if (area.empty()) {
        if (!settings.quiet) std::cout << "nothing has changed in \"" << settings.output << "\"" << std::endl;
        return;
    }
    folder.clear();
    const TileFiles files = folder.files(layout);
    Findings findings;
    const StandingDatabase standing(folder.rootFile(), folder.standingFiles(layout), layout);
    const std::vector<Task> tasks = changedTasks(Updater(settings, layout, standing, files, area, findings), layout);
    Progress progress(!settings.quiet, weightOf(tasks));
    TaskBoard board(tasks);
    StartTiles starts(settings, layout);
    Threads threads(settings.threads, board, [&] {
        Updater updater(settings, layout, standing, files, area, findings);
        while (const auto task = board.next()) {
            updater.update(*task, progress);
            board.finish();
        }
        if (board.isFinished()) starts.build(updater.builder());
    });
    threads.join();
    board.rethrow();
    folder.merge(starts.rootBytes(), sources, findings.removed());
    progress.finish();
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"
#include "Database.h"
#include "DatabaseFolder.h"
#include "EdgeDepths.h"
#include "Failure.h"
#include "NodeFile.h"
#include "TaskWork.h"
#include "TileBuilder.h"
#include "TileFiles.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Group>
#include <osgDB/ReadFile>

#include <algorithm>
#include <functional>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::support::Failure;

namespace {

std::vector<AnalyticBin> binsFrom(const std::string& file, std::size_t tiles) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file, options);
    const osg::Group* group = node ? node->asGroup() : nullptr;
    if (group == nullptr || group->getNumChildren() != tiles) {
        throw Failure("\"" + file + "\" is not as osgbindem wrote it; build the database anew, without --update");
    }
    std::vector<AnalyticBin> bins;
    for (unsigned int i = 0; i < tiles; ++i) bins.push_back(osgAnalyticBin::storedBin(*group->getChild(i)));
    return bins;
}

/// A finished database that is to be updated. Not for use by several threads: each has its own copy. The root file is
/// large: the copies read it once together, when one of them needs it.
class StandingDatabase final {
public:
    StandingDatabase(const std::string& rootFile, TileFiles files, const TileLayout& layout)
        : _layout(layout),
          _files(std::move(files)),
          _starts(std::async(std::launch::deferred, binsFrom, rootFile, layout.startTiles().size()).share()) {}

    [[nodiscard]] bool hasChildren(const TileId& tile) const { return _files.hasChildren(tile); }

    /// The bin that is stored with a tile. Throws Failure when the tile is not there.
    [[nodiscard]] AnalyticBin bin(const TileId& tile) {
        const AnalyticBin& bin = tile.level == _layout.startLevel() ? startBin(tile) : binBesideSiblings(tile);
        if (!bin.valid()) throw Failure("tile " + tileName(tile) + " has no bin; build the database anew");
        return bin;
    }

private:
    using Bins = std::vector<AnalyticBin>;

    [[nodiscard]] const AnalyticBin& startBin(const TileId& tile) const {
        const std::vector<TileId>& tiles = _layout.startTiles();
        return _starts.get()[static_cast<std::size_t>(std::find(tiles.begin(), tiles.end(), tile) - tiles.begin())];
    }
    [[nodiscard]] const AnalyticBin& binBesideSiblings(const TileId& tile) {
        const TileId parent = tile.ancestor(tile.level - 1);
        if (!(_parent == parent)) {
            _siblings = binsFrom(_files.pathOfChildren(parent), 4);
            _parent = parent;
        }
        return _siblings[static_cast<std::size_t>(tile.x % 2 + 2 * (tile.y % 2))];
    }

    const TileLayout& _layout;
    TileFiles _files;
    std::shared_future<Bins> _starts;
    std::optional<TileId> _parent;
    Bins _siblings;
};

/// Tells which tiles of a database come out as they are when it is built again.
///
/// A tile's mesh depends on heights within one spacing of posts around it, or on those between the posts of a coarser
/// neighbour along the edge; its skirts depend besides on which of its neighbours, of those above them, and of those
/// below them along the edge have children. Its bin depends on the tiles below. What changes for a tile changes for all
/// above it, so a tile that stays has no changes below.
class ChangedTiles final {
public:
    using HadChildren = std::function<bool(const TileId&)>;

    /// `depths` of the rasters as they are now; `hadChildren` of the database as it is.
    ChangedTiles(const ChangedArea& area, EdgeDepths& depths, const TileLayout& layout, HadChildren hadChildren)
        : _area(area), _depths(depths), _layout(layout), _hadChildren(std::move(hadChildren)) {}

    /// Whether the tile, or one below it, may come out otherwise.
    [[nodiscard]] bool has(const TileId& tile) const {
        if (hasChangedHeights(tile)) return true;
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto neighbour = tile.neighbour(edge);
            if (!neighbour) return false;
            return isRefinedOtherwiseAbove(*neighbour) || isRefinedOtherwiseAlong(*neighbour, oppositeOf(edge));
        });
    }

private:
    [[nodiscard]] bool hasChangedHeights(const TileId& tile) const {
        int coarsest =
            std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, _depths.coarsestAcross(tile, edge));
        return _area.touches(tile.rect().grownBy(_layout.spacingDeg(coarsest)));
    }
    [[nodiscard]] bool isRefinedOtherwise(const TileId& tile) const {
        return _area.touches(tile.rect()) && _depths.hasChildren(tile) != _hadChildren(tile);
    }
    [[nodiscard]] bool isRefinedOtherwiseAbove(const TileId& neighbour) const {
        for (int level = _layout.startLevel(); level <= neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            if (isRefinedOtherwise(above)) return true;
            if (!_depths.hasChildren(above)) return false;
        }
        return false;
    }
    [[nodiscard]] bool isRefinedOtherwiseAlong(const TileId& neighbour, Edge edge) const {
        if (!_area.touches(neighbour.rect())) return false;
        if (isRefinedOtherwise(neighbour)) return true;
        if (!_depths.hasChildren(neighbour)) return false;
        const std::array<TileId, 2> children = childrenAlong(neighbour, edge);
        return isRefinedOtherwiseAlong(children[0], edge) || isRefinedOtherwiseAlong(children[1], edge);
    }

    const ChangedArea& _area;
    EdgeDepths& _depths;
    const TileLayout& _layout;
    HadChildren _hadChildren;
};

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
    std::vector<Task> tasks = planTasks(updater.builder().mosaic(), layout);
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

void updateDatabase(const Settings& given) {
    prepareNodeFiles();
    const Settings settings = withDeclaredRadii(given);
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

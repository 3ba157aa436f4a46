// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"
#include "DatabaseFolder.h"
#include "Failure.h"
#include "SkirtMeasure.h"
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
#include <iterator>
#include <memory>
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
            return _area.touches(neighbour->rect()) || isRefinedOtherwiseAbove(*neighbour);
        });
    }

private:
    [[nodiscard]] bool hasChangedHeights(const TileId& tile) const {
        int coarsest =
            std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, _depths.coarsestAcross(tile, edge));
        return _area.touches(tile.rect().grownBy(_layout.spacingDeg(coarsest)));
    }
    [[nodiscard]] bool isRefinedOtherwiseAbove(const TileId& neighbour) const {
        for (int level = _layout.startLevel(); level < neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            const bool hasChildren = _depths.hasChildren(above);
            if (_area.touches(above.rect()) && hasChildren != _hadChildren(above)) return true;
            if (!hasChildren) return false;
        }
        return false;
    }

    const ChangedArea& _area;
    EdgeDepths& _depths;
    const TileLayout& _layout;
    HadChildren _hadChildren;
};

/// A builder's way through the tiles of a database: what does not change is taken from there.
class Updater {
public:
    /// Tiles whose children are no longer there.
    struct Removed {
        std::mutex mutex;
        std::set<TileId> tiles;
    };

    Updater(TileBuilder& builder, const TileLayout& layout, const StandingDatabase& standing, const ChangedArea& area,
            Removed& removed)
        : _builder(builder),
          _standing(standing),
          _changed(area, builder.depths(), layout, [this](const TileId& tile) { return _standing.hasChildren(tile); }),
          _removed(removed) {}
    Updater(const Updater&) = delete;
    Updater& operator=(const Updater&) = delete;

    [[nodiscard]] bool hasChanged(const TileId& tile) const { return _changed.has(tile); }

    /// A tile with everything below it as it is; the bin of a tile holds whatever is below. Returns: nullopt where
    /// something changes.
    [[nodiscard]] std::optional<SurveyedTile> find(const TileId& tile) {
        const bool hasChildren = _builder.depths().hasChildren(tile);
        if (!hasChildren) removeBelow(tile);
        if (!hasChildren || _changed.has(tile)) return std::nullopt;
        SurveyedTile surveyed = _builder.surveyAlone(tile);
        surveyed.below = _standing.bin(tile);
        surveyed.range = {surveyed.below.bin().altitude().lower, surveyed.below.bin().altitude().upper};
        return surveyed;
    }

private:
    void removeBelow(const TileId& tile) {
        if (!_standing.hasChildren(tile)) return;
        {
            const std::lock_guard<std::mutex> guard(_removed.mutex);
            _removed.tiles.insert(tile);
        }
        for (const TileId& child : tile.children()) removeBelow(child);
    }

    TileBuilder& _builder;
    StandingDatabase _standing;
    ChangedTiles _changed;
    Removed& _removed;
};

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
    const StandingDatabase standing(folder.rootFile(), folder.standingFiles(layout), layout);
    Updater::Removed removed;
    std::vector<Task> tasks;
    {
        TileBuilder builder(settings, layout, files);
        const Updater updater(builder, layout, standing, area, removed);
        const std::vector<Task> plan = planTasks(builder.mosaic(), layout);
        std::copy_if(plan.begin(), plan.end(), std::back_inserter(tasks),
                     [&](const Task& task) { return updater.hasChanged(task.tile); });
    }
    const BuildState state(folder.stateFolder());
    Progress progress(!settings.quiet, weightOf(tasks));
    const Site site{settings, layout, files, state, progress, [&](TileBuilder& builder) {
                        const auto updater = std::make_shared<Updater>(builder, layout, standing, area, removed);
                        return [updater](const TileId& tile) { return updater->find(tile); };
                    }};
    TaskBoard board(tasks);
    StartTiles starts(settings, layout);
    startThreads(site, tasks, board, &starts).clear();
    if (board.hasFailed()) folder.clear();
    board.rethrow();
    folder.merge(starts.rootBytes(), sources, {removed.tiles.begin(), removed.tiles.end()});
    progress.finish();
}

}  // namespace osgbindem

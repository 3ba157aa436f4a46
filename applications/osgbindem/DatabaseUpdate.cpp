// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"
#include "RasterFile.h"
#include "SkirtMeasure.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Group>
#include <osgDB/ReadFile>

#include <iostream>
#include <iterator>
#include <set>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;

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

/// Tells builders which tiles of the database come out as they stand, and takes those over. For all threads.
///
/// A tile's mesh depends on heights within one spacing of posts around it, or on those between the posts of a coarser
/// neighbour along the edge; its skirts depend besides on which of its neighbours, of those above them, and of those
/// below them along the edge have children. Its bin depends on the tiles below. What changes for a tile changes for all
/// above it, so a tile that stays has no changes below.
class Update final {
public:
    Update(const DatabaseFolder& folder, const TileLayout& layout, ChangedArea area)
        : _layout(layout),
          _files(folder.standingFiles()),
          _starts(binsFrom(folder.rootFile(), layout.startTiles().size())),
          _area(std::move(area)) {}

    /// Whether the tile, or one below it, may come out otherwise.
    [[nodiscard]] bool hasChanged(TileBuilder& builder, const TileId& tile) const {
        int coarsest =
            std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, builder.skirts().coarsestAcross(tile, edge));
        if (touches(_area, tile.rect().grownBy(_layout.spacingDeg(coarsest)))) return true;
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto neighbour = tile.neighbour(edge);
            return neighbour && (touches(_area, neighbour->rect()) || isRefinedOtherwiseAbove(builder, *neighbour));
        });
    }

    /// A tile with everything below it as it is; the bin of a tile holds whatever is below. Returns: nullopt where
    /// something changes. Throws Failure.
    [[nodiscard]] std::optional<SurveyedTile> find(TileBuilder& builder, const TileId& tile) {
        const bool hasChildren = builder.skirts().hasChildren(tile);
        if (!hasChildren) removeBelow(tile);
        if (!hasChildren || hasChanged(builder, tile)) return std::nullopt;
        SurveyedTile surveyed = builder.surveyAlone(tile);
        surveyed.below = standingBin(tile);
        if (!surveyed.below.valid()) throw Failure("tile " + tileName(tile) + " has no bin; build the database anew");
        surveyed.range = surveyed.below.bin().altitude();
        return surveyed;
    }

    /// Tiles whose children are no longer there. Requires: no thread is at work.
    [[nodiscard]] std::vector<TileId> removed() const { return {_removed.begin(), _removed.end()}; }

private:
    [[nodiscard]] bool isRefinedOtherwiseAbove(TileBuilder& builder, const TileId& neighbour) const {
        for (int level = _layout.startLevel(); level < neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            const bool hasChildren = builder.skirts().hasChildren(above);
            if (touches(_area, above.rect()) && hasChildren != _files.hasChildren(above)) return true;
            if (!hasChildren) return false;
        }
        return false;
    }
    [[nodiscard]] AnalyticBin standingBin(const TileId& tile) const {
        if (tile.level == _layout.startLevel()) {
            const std::vector<TileId>& tiles = _layout.startTiles();
            const auto place = std::find(tiles.begin(), tiles.end(), tile) - tiles.begin();
            return _starts[static_cast<std::size_t>(place)];
        }
        return binsFrom(_files.pathOfChildren(tile.ancestor(tile.level - 1)),
                        4)[static_cast<std::size_t>(tile.x % 2 + 2 * (tile.y % 2))];
    }
    void removeBelow(const TileId& tile) {
        if (!_files.hasChildren(tile)) return;
        {
            const std::lock_guard<std::mutex> guard(_mutex);
            _removed.insert(tile);
        }
        for (const TileId& child : tile.children()) removeBelow(child);
    }

    const TileLayout& _layout;
    /// Of the database as it is.
    const TileFiles& _files;
    /// Bins of the start tiles.
    const std::vector<AnalyticBin> _starts;
    const ChangedArea _area;
    std::mutex _mutex;
    std::set<TileId> _removed;
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
    Update update(folder, layout, area);
    folder.clear();
    std::vector<Task> tasks;
    {
        TileBuilder builder(settings, layout, folder.files());
        const std::vector<Task> plan = planTasks(builder.mosaic(), layout);
        std::copy_if(plan.begin(), plan.end(), std::back_inserter(tasks),
                     [&](const Task& task) { return update.hasChanged(builder, task.tile); });
    }
    Progress progress(!settings.quiet, tasks);
    const Site site{settings, layout, folder, progress,
                    [&](TileBuilder& builder, const TileId& tile) { return update.find(builder, tile); }};
    std::string root;
    try {
        doTasks(site, tasks, nullptr);
        root = rootFileBytes(buildStarts(site, tasks), settings, layout);
    } catch (...) {
        folder.clear();
        throw;
    }
    folder.merge(root, sources, update.removed());
    progress.finish();
}

}  // namespace osgbindem

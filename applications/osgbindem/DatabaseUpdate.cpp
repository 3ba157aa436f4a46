// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseFolder.h"
#include "Failure.h"
#include "RasterLayer.h"
#include "SkirtMeasure.h"
#include "TaskWork.h"
#include "TileBuilder.h"
#include "TileFiles.h"
#include "TileLayout.h"
#include "VoidFill.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/Version.h>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <osg/Group>
#include <osg/Version>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <future>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::support::Failure;

namespace {

constexpr const char* kFoundLevels = "levels found ";
constexpr const char* kElevation = "elevation ";
constexpr const char* kImage = "image ";

// To be raised when the same settings come to make other files.
constexpr int kFormat = 5;

std::string wholePath(const std::string& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::canonical(path, error);
    return error ? path : whole.string();  // GDAL has names that are no files
}

void describeFile(const std::string& path, std::ostream& out) {
    VSIStatBufL status{};
    const bool isThere = VSIStatL(path.c_str(), &status) == 0;
    out << ", file " << wholePath(path);
    if (isThere) out << ' ' << status.st_size << ' ' << status.st_mtim.tv_sec << '.' << status.st_mtim.tv_nsec;
}

/// How far from a change of a coarser raster heights of this one's voids may change, in degrees.
double reachOf(const RasterGrid& grid, const Settings& settings, const TileLayout& layout) {
    const RectDeg extent = grid.extent();
    double spacing =
        std::max((extent.east - extent.west) / grid.columns(), (extent.north - extent.south) / grid.rows());
    // An overview may be read in place of the raster.
    if (settings.useOverviews) spacing = std::max(spacing, 2.0 * layout.spacingDeg(layout.deepestLevel()));
    return VoidFill::kMostReach * spacing;
}

/// Rasters of all layers in the order of the command line, a line each. `reach`: of a raster's voids, in degrees.
template <typename Reach>
void describeRasters(const RasterLayer::Layers& layers, const char* kind, std::ostream& out, const Reach& reach) {
    std::map<std::size_t, const RasterLayer::Member*> members;
    for (const auto& layer : layers)
        for (const RasterLayer::Member& member : layer->members()) members[member.number] = &member;
    for (const auto& [number, member] : members) {
        // Where heights or colours may depend on the raster.
        const RectDeg area = member->grid.extent().grownBy(member->grid.resolutionDeg());
        out << kind << reach(member->grid) << ' ' << member->grid.resolutionDeg() << ' ' << area.west << ' '
            << area.south << ' ' << area.east << ' ' << area.north << ' ' << wholePath(member->file->path())
            << ", blended over ";
        member->band.describe(out);
        out << ", scale " << member->file->options().metresPerUnit.value_or(0.0);
        // A raster may be made of many files: a mosaic, or one with overviews beside it.
        const CPLStringList files(member->file->file().GetFileList());
        for (int i = 0; i < files.Count(); ++i) describeFile(files[i], out);
        out << '\n';
    }
}

}  // namespace

std::string describeSources(const Settings& settings, const TileLayout& layout) {
    std::ostringstream out;
    out << std::setprecision(std::numeric_limits<double>::max_digits10);
    out << "osgbindem " << osgAnalyticBin::version() << ", format " << kFormat << ", GDAL "
        << GDALVersionInfo("RELEASE_NAME") << ", OpenSceneGraph " << osgGetVersion() << '\n';
    out << (settings.levels ? "levels given " : kFoundLevels) << layout.deepestLevel() << '\n';
    out << "cells " << layout.cells() << ", lod factor " << settings.lodFactor << ", packed " << settings.packed
        << ", compressed " << settings.compress << ", overviews " << settings.useOverviews << '\n';
    out << "radii " << settings.ellipsoid.equatorialRadius() << ' ' << settings.ellipsoid.polarRadius() << ", WGS 84 "
        << settings.isWgs84 << '\n';
    if (settings.region) {
        const RectDeg& region = *settings.region;
        out << "region " << region.west << ' ' << region.south << ' ' << region.east << ' ' << region.north << '\n';
    }
    if (!settings.geoid.empty()) {
        const bool isFile = settings.geoid != "none" && settings.geoid != "egm96";
        out << "geoid " << (isFile ? wholePath(settings.geoid) : settings.geoid);
        if (isFile) describeFile(settings.geoid, out);
        out << '\n';
    }
    if (settings.band) out << "band " << *settings.band << '\n';
    for (const std::string& word : settings.config) out << "GDAL " << word << '\n';
    if (settings.nodata) out << "nodata " << *settings.nodata << '\n';
    describeRasters(RasterLayer::elevationOf(settings, &layout), kElevation, out,
                    [&](const RasterGrid& grid) { return reachOf(grid, settings, layout); });
    describeRasters(RasterLayer::imagesOf(settings), kImage, out, [](const RasterGrid&) { return 0.0; });
    return out.str();
}

namespace {

/// Where heights, how fine they are, or colours may have changed since a database was built: rectangles of posts, with
/// the cells between them and their neighbours.
using ChangedArea = std::vector<RectDeg>;

/// Whether they have a point in common with the rectangle; longitudes count modulo 360, a pole is one point.
bool touches(const ChangedArea& area, const RectDeg& rect) noexcept {
    const auto haveCommonLongitude = [&](const RectDeg& changed) {
        const double turns = std::floor((changed.west - rect.west) / 360.0);
        return rect.east + 360.0 * turns >= changed.west || rect.west + 360.0 * (turns + 1.0) <= changed.east;
    };
    return std::any_of(area.begin(), area.end(), [&](const RectDeg& changed) {
        if (changed.south > rect.north || changed.north < rect.south) return false;
        const bool isAtPole =
            (changed.north >= 90.0 && rect.north >= 90.0) || (changed.south <= -90.0 && rect.south <= -90.0);
        return isAtPole || haveCommonLongitude(changed);
    });
}

struct Raster {
    /// See reachOf(). No part of what the raster is: it depends on the other rasters too.
    double reachDeg = 0.0;
    double resolutionDeg = 0.0;
    RectDeg area;
    /// All that is said of the raster but its reach.
    std::string text;

    bool operator==(const Raster& other) const { return text == other.text; }
};
using Rasters = std::vector<Raster>;

/// The description of a database taken apart.
struct Sources {
    explicit Sources(const std::string& description) {
        std::istringstream in(description);
        for (std::string line; std::getline(in, line);) {
            if (line.rfind(kElevation, 0) == 0) {
                rasters.push_back(rasterFrom(line.substr(std::strlen(kElevation))));
            } else if (line.rfind(kImage, 0) == 0) {
                images.push_back(rasterFrom(line.substr(std::strlen(kImage))));
            } else if (line.rfind(kFoundLevels, 0) != 0) {
                settings += line + '\n';
            }
        }
    }

    /// Everything but rasters and images, and the levels where nobody gave them.
    std::string settings;
    Rasters rasters;
    Rasters images;

private:
    static Raster rasterFrom(const std::string& line) {
        Raster raster;
        std::istringstream in(line);
        in >> raster.reachDeg;
        std::getline(in, raster.text);
        std::istringstream(raster.text) >> raster.resolutionDeg >> raster.area.west >> raster.area.south >>
            raster.area.east >> raster.area.north;
        return raster;
    }
};

/// Those of the first that are not in the second.
Rasters without(const Rasters& rasters, const Rasters& others) {
    Rasters result;
    std::copy_if(rasters.begin(), rasters.end(), std::back_inserter(result),
                 [&](const Raster& raster) { return std::find(others.begin(), others.end(), raster) == others.end(); });
    return result;
}

void addChanges(const Rasters& before, const Rasters& now, ChangedArea& area) {
    Rasters changed = without(before, now);
    const Rasters added = without(now, before);
    Rasters kept = without(before, changed);
    // Of two equally fine rasters the one named first counts.
    const bool isInOrder = kept == without(now, added);
    changed.insert(changed.end(), added.begin(), added.end());
    if (!isInOrder) {
        changed.insert(changed.end(), kept.begin(), kept.end());
        kept.clear();
    }
    constexpr double kNearlyAsFine = 1.1;  // spacings of what counts as equally fine differ by less
    for (const Raster& raster : changed) {
        // Heights may change where the raster lies, and in the voids of finer ones that are kept.
        double reach = 0.0;
        for (const Raster& other : kept)
            if (other.resolutionDeg <= kNearlyAsFine * raster.resolutionDeg) reach += other.reachDeg;
        area.push_back(raster.area.grownBy(reach));
    }
}

/// Where a database may differ from one that would be built now, by their descriptions.
/// Returns: nullopt when more than rasters and images differs.
std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now) {
    const Sources old(before);
    const Sources current(now);
    if (old.settings != current.settings) return std::nullopt;
    ChangedArea area;
    addChanges(old.rasters, current.rasters, area);
    addChanges(old.images, current.images, area);
    return area;
}

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

/// What builders share that update one database.
struct Change {
    Change(const DatabaseFolder& folder, const TileLayout& tiles, ChangedArea changed)
        : layout(tiles),
          files(folder.standingFiles(tiles)),
          starts(std::async(std::launch::deferred, binsFrom, folder.rootFile(), tiles.startTiles().size()).share()),
          area(std::move(changed)) {}

    const TileLayout& layout;
    /// Of the database as it is.
    const TileFiles files;
    /// Bins of the start tiles. The root file is large: it is read once, when one of the builders needs it.
    const std::shared_future<std::vector<AnalyticBin>> starts;
    const ChangedArea area;
    /// Tiles whose children are no longer there.
    std::mutex mutex;
    std::set<TileId> removed;
};

/// Tells a builder which tiles of the database come out as they stand, and takes those over.
///
/// A tile's mesh depends on heights within one spacing of posts around it, or on those between the posts of a coarser
/// neighbour along the edge; its skirts depend besides on which of its neighbours, of those above them, and of those
/// below them along the edge have children. Its bin depends on the tiles below. What changes for a tile changes for all
/// above it, so a tile that stays has no changes below.
class Updater final {
public:
    Updater(TileBuilder& builder, Change& change) : _builder(builder), _change(change), _layout(change.layout) {}
    Updater(const Updater&) = delete;
    Updater& operator=(const Updater&) = delete;

    /// Whether the tile, or one below it, may come out otherwise.
    [[nodiscard]] bool hasChanged(const TileId& tile) const {
        int coarsest =
            std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, _builder.skirts().coarsestAcross(tile, edge));
        if (touches(_change.area, tile.rect().grownBy(_layout.spacingDeg(coarsest)))) return true;
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto neighbour = tile.neighbour(edge);
            return neighbour && (touches(_change.area, neighbour->rect()) || isRefinedOtherwiseAbove(*neighbour));
        });
    }

    /// A tile with everything below it as it is; the bin of a tile holds whatever is below. Returns: nullopt where
    /// something changes. Throws Failure.
    [[nodiscard]] std::optional<SurveyedTile> find(const TileId& tile) {
        const bool hasChildren = _builder.skirts().hasChildren(tile);
        if (!hasChildren) removeBelow(tile);
        if (!hasChildren || hasChanged(tile)) return std::nullopt;
        SurveyedTile surveyed = _builder.surveyAlone(tile);
        surveyed.below = standingBin(tile);
        if (!surveyed.below.valid()) throw Failure("tile " + tileName(tile) + " has no bin; build the database anew");
        surveyed.range = {surveyed.below.bin().altitude().lower, surveyed.below.bin().altitude().upper};
        return surveyed;
    }

private:
    [[nodiscard]] bool isRefinedOtherwiseAbove(const TileId& neighbour) const {
        for (int level = _layout.startLevel(); level < neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            const bool hasChildren = _builder.skirts().hasChildren(above);
            if (touches(_change.area, above.rect()) && hasChildren != _change.files.hasChildren(above)) return true;
            if (!hasChildren) return false;
        }
        return false;
    }
    [[nodiscard]] AnalyticBin standingBin(const TileId& tile) {
        if (tile.level == _layout.startLevel()) {
            const std::vector<TileId>& tiles = _layout.startTiles();
            const auto place = std::find(tiles.begin(), tiles.end(), tile) - tiles.begin();
            return _change.starts.get()[static_cast<std::size_t>(place)];
        }
        const TileId parent = tile.ancestor(tile.level - 1);
        if (!(_parent == parent)) {
            _siblings = binsFrom(_change.files.pathOfChildren(parent), 4);
            _parent = parent;
        }
        return _siblings[static_cast<std::size_t>(tile.x % 2 + 2 * (tile.y % 2))];
    }
    void removeBelow(const TileId& tile) {
        if (!_change.files.hasChildren(tile)) return;
        {
            const std::lock_guard<std::mutex> guard(_change.mutex);
            _change.removed.insert(tile);
        }
        for (const TileId& child : tile.children()) removeBelow(child);
    }

    TileBuilder& _builder;
    Change& _change;
    const TileLayout& _layout;
    /// The bins of the last file that was read, and whose children they are of.
    std::optional<TileId> _parent;
    std::vector<AnalyticBin> _siblings;
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
    Change change(folder, layout, requireUpdatable(folder, sources));
    if (change.area.empty()) {
        if (!settings.quiet) std::cout << "nothing has changed in \"" << settings.output << "\"" << std::endl;
        return;
    }
    folder.clear();
    std::vector<Task> tasks;
    {
        const TileFiles files = folder.files(layout);
        TileBuilder builder(settings, layout, files);
        const Updater updater(builder, change);
        const std::vector<Task> plan = planTasks(builder.mosaic(), layout);
        std::copy_if(plan.begin(), plan.end(), std::back_inserter(tasks),
                     [&](const Task& task) { return updater.hasChanged(task.tile); });
    }
    Progress progress(!settings.quiet, weightOf(tasks));
    const Site site{settings, layout, folder, progress, [&](TileBuilder& builder) {
                        const auto updater = std::make_shared<Updater>(builder, change);
                        return [updater](const TileId& tile) { return updater->find(tile); };
                    }};
    std::string root;
    try {
        doTasks(site, tasks, nullptr);
        root = rootFileBytes(buildStarts(site, tasks), settings, layout);
    } catch (...) {
        folder.clear();
        throw;
    }
    folder.merge(root, sources, {change.removed.begin(), change.removed.end()});
    progress.finish();
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"
#include "ImageMosaic.h"
#include "RasterLayer.h"
#include "SkirtMeasure.h"

#include <osgAnalyticBin/Version.h>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <osg/Version>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <system_error>

namespace osgbindem {

namespace {

constexpr const char* kFoundLevels = "levels found ";
constexpr const char* kElevation = "elevation ";
constexpr const char* kImage = "image ";

// To be raised when the same settings come to make other files.
constexpr int kFormat = 8;

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

/// Whatever of a raster decides what is made of it, in a line. `band`: of elevation.
void describeRaster(const RasterFile& raster, const char* kind, const BlendBand& band, std::ostream& out) {
    // Where heights or colours may depend on the raster: up to the next posts of finer ones.
    const RectDeg area = raster.extent.grownBy(4.0 * std::max(raster.eastDeg, raster.northDeg));
    out << kind << area.west << ' ' << area.south << ' ' << area.east << ' ' << area.north << ' '
        << wholePath(raster.input.path) << ", " << raster.eastDeg << ' ' << raster.northDeg
        << " degrees, blended over ";
    band.describe(out);
    out << ", scale " << raster.input.metresPerUnit.value_or(0.0);
    // A raster may be made of many files: a mosaic, or one with overviews beside it.
    const CPLStringList files(raster.file->GetFileList());
    for (int i = 0; i < files.Count(); ++i) describeFile(files[i], out);
    out << '\n';
}

struct Raster {
    RectDeg area;
    /// Describes the raster.
    std::string text;

    bool operator==(const Raster& other) const { return text == other.text; }
};
using Rasters = std::vector<Raster>;

/// The description of a database taken apart.
struct Sources {
    explicit Sources(const std::string& description) {
        std::istringstream in(description);
        for (std::string line; std::getline(in, line);) {
            const std::string kind = line.substr(0, line.find(' ') + 1);
            if (kind == kElevation || kind == kImage) {
                Raster& raster = rasters[kind].emplace_back();
                raster.text = line.substr(kind.size());
                std::istringstream(raster.text) >> raster.area.west >> raster.area.south >> raster.area.east >>
                    raster.area.north;
            } else if (line.rfind(kFoundLevels, 0) != 0) {
                settings += line + '\n';
            }
        }
    }

    /// Everything but rasters and images, and the levels where nobody gave them.
    std::string settings;
    /// By their kind.
    std::map<std::string, Rasters> rasters;
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
    const Rasters kept = without(before, changed);
    // Of two rasters that are equally fine, the one that is named first counts.
    const bool isInOrder = kept == without(now, added);
    changed.insert(changed.end(), added.begin(), added.end());
    if (!isInOrder) changed.insert(changed.end(), kept.begin(), kept.end());
    for (const Raster& raster : changed) area.push_back(raster.area);
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
    if (settings.nodata) out << "nodata " << *settings.nodata << '\n';
    for (const auto& layer : RasterLayer::elevationOf(settings, &layout))
        describeRaster(layer->file(), kElevation, layer->band(), out);
    for (const RasterFile& image : ImageMosaic::imagesOf(settings)) describeRaster(image, kImage, {}, out);
    return out.str();
}

bool touches(const ChangedArea& area, const RectDeg& rect) noexcept {
    return std::any_of(area.begin(), area.end(), [&](const RectDeg& changed) {
        if (changed.south > rect.north || changed.north < rect.south) return false;
        const bool isAtPole =
            (changed.north >= 90.0 && rect.north >= 90.0) || (changed.south <= -90.0 && rect.south <= -90.0);
        const RectDeg turned = changed.turnedTo(rect);
        return isAtPole || (turned.west <= rect.east && turned.east >= rect.west);
    });
}

std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now) {
    Sources old(before);
    Sources current(now);
    if (old.settings != current.settings) return std::nullopt;
    ChangedArea area;
    for (const char* kind : {kElevation, kImage}) addChanges(old.rasters[kind], current.rasters[kind], area);
    return area;
}

std::size_t takeOverUnchanged(const Settings& settings, const TileLayout& layout, const std::vector<Task>& plan,
                              const ChangedArea& area, const DatabaseFolder& folder) {
    DemMosaic mosaic(settings, &layout);
    SkirtMeasure tiles(mosaic, layout);
    const auto isRefinedOtherwiseAbove = [&](const TileId& neighbour) {
        for (int level = layout.startLevel(); level < neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            const bool hasChildren = tiles.hasChildren(above);
            if (touches(area, above.rect()) && hasChildren != folder.standingFiles().hasChildren(above)) return true;
            if (!hasChildren) return false;
        }
        return false;
    };
    // Whether the tile, or one below it, may come out otherwise. A mesh depends on heights within one spacing of posts
    // around it, or on those between the posts of a coarser neighbour along the edge; its skirts depend besides on
    // which of its neighbours, of those above them, and of those below them along the edge have children. The bin
    // depends on the tiles below.
    const auto hasChanged = [&](const TileId& tile) {
        int coarsest = std::max(tile.level - 1, layout.startLevel());  // skirts reach down to the parent's level
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, tiles.coarsestAcross(tile, edge));
        if (touches(area, tile.rect().grownBy(layout.spacingDeg(coarsest)))) return true;
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto neighbour = tile.neighbour(edge);
            return neighbour && (touches(area, neighbour->rect()) || isRefinedOtherwiseAbove(*neighbour));
        });
    };
    const auto count = std::count_if(plan.begin(), plan.end(), [&](const Task& task) {
        return !hasChanged(task.tile) && folder.takeOver(task.tile);
    });
    return static_cast<std::size_t>(count);
}

}  // namespace osgbindem

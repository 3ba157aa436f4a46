// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"

#include "RasterLayer.h"
#include "VoidFill.h"

#include <osgAnalyticBin/Version.h>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <osg/Version>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <system_error>
#include <vector>

namespace osgbindem {

namespace {

constexpr const char* kFoundLevels = "levels found ";
constexpr const char* kElevation = "elevation ";
constexpr const char* kImage = "image ";
constexpr const char* kArea = "  area ";
constexpr const char* kReach = "  reach ";

// To be raised when the same settings come to make other files.
constexpr int kFormat = 4;

std::string wholePath(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return path;  // GDAL has names that are no files
    const std::filesystem::path whole = std::filesystem::canonical(path, error);
    return error ? path : whole.string();
}

void describeFile(const std::string& path, std::ostream& out) {
    VSIStatBufL status{};
    const bool isThere = VSIStatL(path.c_str(), &status) == 0;
    out << "  file " << wholePath(path);
    if (isThere) out << ' ' << status.st_size << ' ' << status.st_mtim.tv_sec << '.' << status.st_mtim.tv_nsec;
    out << '\n';
}

/// A raster may be made of many files: a mosaic, or one with overviews beside it.
void describeFiles(GDALDataset& dataset, std::ostream& out) {
    char** files = dataset.GetFileList();
    for (int i = 0; i < CSLCount(files); ++i) describeFile(files[i], out);
    CSLDestroy(files);
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

/// Rasters of all layers in the order of the command line. `describe`: says what is special, under a raster's name.
template <typename Describe>
void describeRasters(const RasterLayer::Layers& layers, const char* kind, std::ostream& out, const Describe& describe) {
    std::vector<const RasterLayer::Member*> members;
    for (const auto& layer : layers) {
        for (const RasterLayer::Member& member : layer->members()) members.push_back(&member);
    }
    std::sort(members.begin(), members.end(), [](const auto* a, const auto* b) { return a->number < b->number; });
    for (const RasterLayer::Member* member : members) {
        out << kind << wholePath(member->file->path()) << '\n';
        // Where heights or colours may depend on the raster.
        const RectDeg area = member->grid.extent().grownBy(member->grid.resolutionDeg());
        out << kArea << area.west << ' ' << area.south << ' ' << area.east << ' ' << area.north << '\n';
        out << "  blended over ";
        member->band.describe(out);
        out << '\n';
        describe(*member);
        describeFiles(member->file->file(), out);
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
        out << "geoid " << (isFile ? wholePath(settings.geoid) : settings.geoid) << '\n';
        if (isFile) describeFile(settings.geoid, out);
    }
    if (settings.band) out << "band " << *settings.band << '\n';
    for (const std::string& word : settings.config) out << "GDAL " << word << '\n';
    if (settings.nodata) out << "nodata " << *settings.nodata << '\n';
    describeRasters(RasterLayer::elevationOf(settings, &layout), kElevation, out, [&](const auto& member) {
        const auto scale = settings.dems[member.number].metresPerUnit;
        if (scale) out << "  scale " << *scale << '\n';
        out << kReach << member.grid.resolutionDeg() << ' ' << reachOf(member.grid, settings, layout) << '\n';
    });
    describeRasters(RasterLayer::imagesOf(settings), kImage, out, [](const auto&) {});
    return out.str();
}

namespace {

bool haveCommonLongitude(const RectDeg& a, const RectDeg& b) noexcept {
    const double turns = std::floor((a.west - b.west) / 360.0);
    for (const double turn : {turns, turns + 1.0}) {
        if (b.west + 360.0 * turn <= a.east && b.east + 360.0 * turn >= a.west) return true;
    }
    return false;
}

}  // namespace

bool ChangedArea::touches(const RectDeg& rect) const noexcept {
    return std::any_of(_rects.begin(), _rects.end(), [&](const RectDeg& changed) {
        if (changed.south > rect.north || changed.north < rect.south) return false;
        const bool isAtPole =
            (changed.north >= 90.0 && rect.north >= 90.0) || (changed.south <= -90.0 && rect.south <= -90.0);
        return isAtPole || haveCommonLongitude(changed, rect);
    });
}

namespace {

struct Raster {
    std::string text;
    RectDeg area;
    double resolutionDeg = 0.0;
    /// See reachOf(). No part of what the raster is: it depends on the other rasters too.
    double reachDeg = 0.0;

    bool operator==(const Raster& other) const { return text == other.text; }
};

/// The description of a database taken apart.
struct Sources {
    /// Everything but rasters and images, and the levels where nobody gave them.
    std::string settings;
    std::vector<Raster> rasters;
    std::vector<Raster> images;
};

Sources sourcesFrom(const std::string& description) {
    Sources sources;
    std::vector<Raster>* list = nullptr;  // whose last one the lines are of
    std::istringstream in(description);
    for (std::string line; std::getline(in, line);) {
        const bool isElevation = line.rfind(kElevation, 0) == 0;
        if (isElevation || line.rfind(kImage, 0) == 0) {
            list = isElevation ? &sources.rasters : &sources.images;
            list->emplace_back();
        } else if (line.rfind("  ", 0) != 0) {
            list = nullptr;
        }
        if (list) {
            Raster& raster = list->back();
            if (line.rfind(kReach, 0) == 0) {
                std::istringstream(line.substr(std::string(kReach).size())) >> raster.resolutionDeg >> raster.reachDeg;
                continue;
            }
            raster.text += line + '\n';
            if (line.rfind(kArea, 0) != 0) continue;
            std::istringstream numbers(line.substr(std::string(kArea).size()));
            numbers >> raster.area.west >> raster.area.south >> raster.area.east >> raster.area.north;
        } else if (line.rfind(kFoundLevels, 0) != 0) {
            sources.settings += line + '\n';
        }
    }
    return sources;
}

/// Those of the first that are not in the second.
std::vector<Raster> without(const std::vector<Raster>& rasters, const std::vector<Raster>& others) {
    std::vector<Raster> result;
    std::copy_if(rasters.begin(), rasters.end(), std::back_inserter(result),
                 [&](const Raster& raster) { return std::find(others.begin(), others.end(), raster) == others.end(); });
    return result;
}

// Rasters of one layer have spacings that differ by less.
constexpr double kNearlyAsFine = 1.1;

/// Where heights may change when the raster does: where it lies, and in the voids of finer ones that are `kept`.
RectDeg changedBy(const Raster& raster, const std::vector<Raster>& kept) {
    double reach = 0.0;
    for (const Raster& other : kept) {
        if (other.resolutionDeg <= kNearlyAsFine * raster.resolutionDeg) reach += other.reachDeg;
    }
    return raster.area.grownBy(reach);
}

void addChanges(const std::vector<Raster>& before, const std::vector<Raster>& now, ChangedArea& area) {
    std::vector<Raster> gone = without(before, now);
    std::vector<Raster> added = without(now, before);
    // Of two equally fine rasters the one named first counts.
    if (without(before, gone) != without(now, added)) {
        gone = before;
        added = now;
    }
    const std::vector<Raster> kept = without(before, gone);
    for (const Raster& raster : gone) area.add(changedBy(raster, kept));
    for (const Raster& raster : added) area.add(changedBy(raster, kept));
}

}  // namespace

std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now) {
    const Sources old = sourcesFrom(before);
    const Sources current = sourcesFrom(now);
    if (old.settings != current.settings) return std::nullopt;
    ChangedArea area;
    addChanges(old.rasters, current.rasters, area);
    addChanges(old.images, current.images, area);
    return area;
}

}  // namespace osgbindem

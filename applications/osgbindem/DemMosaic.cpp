// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemMosaic.h"

#include "Failure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

// A raster that is up to so many times as coarse knows more of a void than the posts around it.
constexpr double kRival = 1.5;

// Half of the memory is GDAL's cache, the other half what the threads keep.
std::size_t blocksPerThread(const Settings& settings) {
    constexpr double kFewest = 16.0;
    constexpr double kBytes = sizeof(double) * VoidFill::kBlock * VoidFill::kBlock;
    const double blocks = std::ldexp(0.5 * settings.memoryMib, 20) / settings.threads.value_or(1) / kBytes;
    return std::min(DemBlocks().most, static_cast<std::size_t>(std::max(kFewest, blocks)));
}

std::string markText(const RasterLook& look, double posts) {
    return CPLSPrintf(
        ": %s%.0f posts with numbers like %g, which no terrain has (where they are heights, see --height-unit)",
        look.posts < posts ? "some " : "", look.marks * posts / look.posts, look.lastMark);
}

}  // namespace

DemMosaic::DemMosaic(const Settings& settings, const TileLayout* layout) {
    const auto blocks = std::make_shared<DemBlocks>();
    blocks->most = blocksPerThread(settings);
    for (auto& layer : RasterLayer::elevationOf(settings, layout)) {
        VerticalShift shift(layer->vertical(), settings.geoid, layer->path());
        _sources.push_back(std::make_unique<DemSource>(std::move(layer), std::move(shift), blocks));
    }
    for (std::size_t i = 0; i + 1 < _sources.size(); ++i) {
        const bool hasRivals = _sources[i + 1]->layer().spacingDeg() <= kRival * _sources[i]->layer().spacingDeg();
        _sources[i]->voids().setCoarser(
            [this, i](int column, int row) { return below(i, _sources[i]->grid().position(column, row)); }, hasRivals);
    }
}

FoundHeight DemMosaic::below(std::size_t source, const PositionDeg& position) {
    auto found = heightFrom(source + 1, position);
    if (!found) return {};
    const double rivalDeg = kRival * _sources[source]->layer().spacingDeg();
    found->metres -= _sources[source]->shift().at(position);
    found->isRival = !found->isFilled && _sources[found->source]->layer().spacingDeg() <= rivalDeg;
    return *found;
}

std::optional<FoundHeight> DemMosaic::heightFrom(std::size_t source, const PositionDeg& position) {
    for (std::size_t i = source; i < _sources.size(); ++i) {
        auto found = _sources[i]->height(position);
        if (!found) continue;
        found->source = i;
        const double own = _sources[i]->layer().share(position);
        if (own == 1.0) return found;
        const auto coarser = heightFrom(i + 1, position);
        if (coarser) found->metres = coarser->metres + own * (found->metres - coarser->metres);
        return found;
    }
    return std::nullopt;
}

Interval DemMosaic::range(const RectDeg& rect) {
    Interval range = Interval::none();
    bool isCovered = false;
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        const bool isComplete = _sources[i]->addRange(rect, range);
        if (isComplete && !_sources[i]->layer().isBlendedIn(rect)) return range;
        isCovered = isCovered || isComplete;
    }
    if (!isCovered) range.expandBy(0.0);
    return range;
}

bool DemMosaic::hasFinerRaster(const RectDeg& rect, double spacingDeg) const noexcept {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->grid().overlap(rect) > 0.0;
    });
}

bool DemMosaic::hasFinerData(const RectDeg& rect, double spacingDeg) {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->hasData(rect);
    });
}

std::vector<std::string> DemMosaic::inspect() {
    std::map<std::string, std::vector<std::string>> notes;  // each with the paths of what it is true of
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        for (const RasterLayer::Member& member : _sources[i]->layer().members()) {
            const RasterFile& file = *member.file;
            const RasterLook look = file.look();
            const std::string marks = look.marks > 0.0 ? markText(look, file.posts()) : std::string();
            if (look.missing == look.posts) {
                throw Failure("no heights in \"" + file.path() + "\", only missing data" + marks +
                              "; leave it out, or see --nodata, --height-unit and --radii");
            }
            for (const std::string& note : file.notes()) notes[note].push_back(file.path());
            const VerticalShift& shift = _sources[i]->shift();
            if (!shift.isNone()) notes["heights above " + shift.what() + ", converted by PROJ"].push_back(file.path());
            if (!marks.empty()) notes["missing data" + marks].push_back(file.path());
        }
    }
    std::vector<std::string> lines;
    for (const auto& [note, paths] : notes) {
        const std::string others = paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " others" : "";
        lines.push_back("\"" + paths.front() + "\"" + others + ": " + note);
    }
    return lines;
}

double DemMosaic::finestDeg() const noexcept {
    return _sources.front()->layer().spacingDeg();
}

double DemMosaic::finestGlobalDeg() const noexcept {
    for (const auto& source : _sources) {
        if (source->grid().isGlobal()) return source->grid().resolutionDeg();
    }
    return finestDeg();
}

double DemMosaic::posts(const RectDeg& rect) const noexcept {
    double sum = 0.0;
    for (const auto& source : _sources) {
        const double resolution = source->grid().resolutionDeg();
        sum += source->layer().overlap(rect) / resolution / resolution;  // whose square may be too small for a number
    }
    return sum;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemMosaic.h"

#include "Failure.h"
#include "TileLayout.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

// Half of the memory is GDAL's cache, the other half the windows that the threads keep.
double postsPerThread(const Settings& settings) {
    const double bytes = std::ldexp(0.5 * settings.memoryMib, 20) / settings.threads;
    return std::min(bytes / sizeof(double), DemSource::kMostPosts);
}

}  // namespace

DemMosaic::DemMosaic(const Settings& settings, double spacingDeg) : _mostPosts(postsPerThread(settings)) {
    for (const DemInput& dem : settings.dems) {
        DemOptions options;
        options.raster.path = dem.path;
        options.raster.nodata = settings.nodata;
        options.raster.isWgs84 = settings.isWgs84;
        options.raster.spacingDeg = settings.useOverviews ? spacingDeg : 0.0;
        options.metresPerUnit = dem.metresPerUnit;
        _sources.push_back(std::make_unique<DemSource>(options));
    }
    std::stable_sort(_sources.begin(), _sources.end(), [](const auto& a, const auto& b) {
        return a->grid().resolutionDeg() < b->grid().resolutionDeg();
    });
    for (const auto& source : _sources) _shifts.emplace_back(source->raster(), settings.geoid);
    for (std::size_t i = 0; i + 1 < _sources.size(); ++i) {
        _sources[i]->setCoarser([this, i](const PositionDeg& position) {
            auto height = heightFrom(i + 1, position);
            if (height) *height -= _shifts[i].at(position);
            return height;
        });
    }
    std::vector<RasterGrid> grids;
    for (const auto& source : _sources) grids.push_back(source->grid());
    for (const RasterGrid& grid : grids) {
        _bands.emplace_back(grid, grids, settings.blend, settings.ellipsoid.equatorialRadius());
    }
}

std::optional<double> DemMosaic::heightFrom(std::size_t source, const PositionDeg& position) {
    for (std::size_t i = source; i < _sources.size(); ++i) {
        auto height = _sources[i]->height(position);
        if (!height) continue;
        if (!_shifts[i].isNone()) *height += _shifts[i].at(position);
        const double share = _bands[i].share(position);
        if (share == 1.0) return height;
        const auto coarser = heightFrom(i + 1, position);
        return coarser ? *coarser + share * (*height - *coarser) : height;
    }
    return std::nullopt;
}

double DemMosaic::height(const PositionDeg& position) {
    return heightFrom(0, position).value_or(0.0);
}

bool DemMosaic::addRange(std::size_t source, const RectDeg& rect, HeightRange& range) {
    if (_shifts[source].isNone()) return _sources[source]->addRange(rect, range);
    HeightRange above;
    const bool isComplete = _sources[source]->addRange(rect, above);
    if (above.empty()) return isComplete;
    // Between these places the geoid differs by no more than its steepest slope allows.
    constexpr int kPlaces = 16;
    constexpr double kSteepest = 25.0;  // metres a degree
    const double margin = kSteepest * std::max(rect.north - rect.south, rect.east - rect.west) / kPlaces;
    HeightRange shift;
    for (int row = 0; row <= kPlaces; ++row) {
        for (int column = 0; column <= kPlaces; ++column) {
            const PositionDeg position{rect.south + (rect.north - rect.south) * row / kPlaces,
                                       rect.west + (rect.east - rect.west) * column / kPlaces};
            if (_sources[source]->grid().locate(position)) shift.include(_shifts[source].at(position));
        }
    }
    if (shift.empty()) return isComplete;
    range.include(above.lower + shift.lower - margin);
    range.include(above.upper + shift.upper + margin);
    return isComplete;
}

HeightRange DemMosaic::range(const RectDeg& rect) {
    HeightRange range;
    bool isCovered = false;
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        const bool isComplete = addRange(i, rect, range);
        if (isComplete && !_bands[i].touches(rect)) return range;
        isCovered = isCovered || isComplete;
    }
    if (!isCovered) range.include(0.0);
    return range;
}

bool DemMosaic::hasFinerData(const RectDeg& rect, double spacingDeg) {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->hasData(rect);
    });
}

void DemMosaic::prefetch(const RectDeg& rect) {
    double left = _mostPosts;
    for (const auto& source : _sources) left -= source->prefetch(rect, left);
}

void DemMosaic::requireData() {
    for (const auto& source : _sources) {
        if (!source->hasAnyData()) {
            throw Failure("no heights in \"" + source->path() + "\", only missing data; leave it out, or see --nodata");
        }
    }
}

double DemMosaic::finestDeg() const noexcept {
    return _sources.front()->grid().resolutionDeg();
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
        sum += source->grid().overlap(rect) / resolution / resolution;  // whose square may be too small for a number
    }
    return sum;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemMosaic.h"

#include "Failure.h"
#include "TileLayout.h"

#include <algorithm>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

DemMosaic::DemMosaic(const Settings& settings) {
    for (const DemInput& dem : settings.dems) {
        DemOptions options;
        options.raster.path = dem.path;
        options.raster.nodata = settings.nodata;
        options.raster.isWgs84 = settings.isWgs84;
        options.metresPerUnit = dem.metresPerUnit;
        _sources.push_back(std::make_unique<DemSource>(options));
    }
    std::stable_sort(_sources.begin(), _sources.end(), [](const auto& a, const auto& b) {
        return a->grid().resolutionDeg() < b->grid().resolutionDeg();
    });
}

double DemMosaic::height(const PositionDeg& position) {
    for (const auto& source : _sources) {
        if (const auto height = source->height(position)) return *height;
    }
    return 0.0;
}

HeightRange DemMosaic::range(const RectDeg& rect) {
    HeightRange range;
    for (const auto& source : _sources) {
        if (source->addRange(rect, range)) return range;
    }
    range.include(0.0);
    return range;
}

bool DemMosaic::hasFinerData(const RectDeg& rect, double spacingDeg) {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->hasData(rect);
    });
}

void DemMosaic::prefetch(const RectDeg& rect) {
    for (const auto& source : _sources) source->prefetch(rect);
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
        sum += source->grid().overlap(rect) / (resolution * resolution);
    }
    return sum;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Terrain.h"

#include "Angles.h"
#include "GlmBridge.h"
#include "RasterLayer.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kDegreesPerRadian;

osgbindem::Settings settingsFor(const std::string& dem) {
    osgbindem::Settings settings;
    settings.dems = {{dem}};
    return settings;
}

osgbindem::RectDeg extentOf(const std::string& dem) {
    const osgbindem::RasterLayer::Layers layers = osgbindem::RasterLayer::elevationOf(settingsFor(dem), nullptr);
    if (layers.front()->grid().isGlobal()) return {-180.0, -90.0, 180.0, 90.0};
    return layers.front()->grid().extent().grownBy(0.0);
}

}  // namespace

Terrain::Terrain(const std::string& dem, int deepestLevel)
    : _ellipsoid(defaultEllipsoid()),
      _mosaic(settingsFor(dem)),
      _extent(extentOf(dem)),
      _heights(static_cast<std::size_t>(deepestLevel) + 1) {
    for (int level = 0; level <= deepestLevel; ++level) {
        const TileId any{level, 0, 0};
        _heights[static_cast<std::size_t>(level)].resize(static_cast<std::size_t>(any.columns() * any.rows()));
    }
    for (int y = 0; y < TileId::kStartRows; ++y)
        for (int x = 0; x < TileId::kStartColumns; ++x) findHeights({0, x, y});
    (void)_mosaic.inspect();
}

core::Interval Terrain::findHeights(const TileId& tile) {
    core::Interval& heights = _heights[level(tile)][place(tile)];
    if (tile.level == deepestLevel()) {
        const core::Interval range = _mosaic.range(tile.rect());
        return heights = {std::max(range.lower, 0.0), std::max(range.upper, 0.0)};
    }
    heights = core::Interval::none();
    for (const TileId& child : tile.children()) heights = heights.united(findHeights(child));
    return heights;
}

core::GeodeticBin Terrain::bin(const TileId& tile) const {
    const osgbindem::RectDeg rect = tile.rect();
    return core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, heights(tile));
}

double Terrain::height(const osgbindem::PositionDeg& position) {
    return std::max(_mosaic.height(position), 0.0);
}

core::Geodetic Terrain::onSurface(const core::Geodetic& position) {
    return {position.latitude, position.longitude,
            height({position.latitude * kDegreesPerRadian, position.longitude * kDegreesPerRadian})};
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Terrain.h"

#include "GlmBridge.h"
#include "RasterLayer.h"

#include <glm/trigonometric.hpp>

#include <algorithm>

namespace osgAnalyticBin::paper {

namespace {

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
    : _ellipsoid(defaultEllipsoid()), _mosaic(settingsFor(dem)), _extent(extentOf(dem)), _deepestLevel(deepestLevel) {
    (void)_mosaic.inspect();
}

const core::GeodeticBin& Terrain::bin(const TileId& tile) {
    const auto [known, isNew] = _bins.try_emplace(tile);
    if (!isNew) return known->second;
    const osgbindem::RectDeg rect = tile.rect();
    core::Interval heights = core::Interval::none();
    if (tile.level == _deepestLevel) {
        const core::Interval range = _mosaic.range(rect);
        heights = {std::max(range.lower, 0.0), std::max(range.upper, 0.0)};
    } else {
        for (const TileId& child : tile.children()) heights = heights.united(bin(child).altitude());
    }
    return known->second = core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, heights);
}

double Terrain::height(const osgbindem::PositionDeg& position) {
    return std::max(_mosaic.height(position), 0.0);
}

core::Geodetic Terrain::onSurface(const core::Geodetic& position) {
    return {position.latitude, position.longitude,
            height({glm::degrees(position.latitude), glm::degrees(position.longitude)})};
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Terrain.h"

#include "Angles.h"
#include "Failure.h"

#include <osg/CoordinateSystemNode>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace osgAnalyticBin::paper {

using support::Failure;

namespace {

using support::kDegreesPerRadian;

std::unique_ptr<osgbindem::RasterLayer> layerOf(const std::string& dem) {
    osgbindem::Settings settings;
    settings.dems = {{dem}};
    return std::move(osgbindem::RasterLayer::elevationOf(settings, nullptr).front());
}

}  // namespace

core::Ellipsoid wgs84() {
    const osg::ref_ptr<osg::EllipsoidModel> model = new osg::EllipsoidModel;
    return {model->getRadiusEquator(), model->getRadiusPolar()};
}

Terrain::Terrain(const std::string& dem, int deepestLevel)
    : _ellipsoid(wgs84()), _source(layerOf(dem)), _heights(static_cast<std::size_t>(deepestLevel) + 1) {
    for (int level = 0; level <= deepestLevel; ++level) {
        const TileId any{level, 0, 0};
        _heights[static_cast<std::size_t>(level)].resize(static_cast<std::size_t>(any.columns() * any.rows()));
    }
    for (int y = 0; y < TileId::kStartRows; ++y)
        for (int x = 0; x < TileId::kStartColumns; ++x) findHeights({0, x, y});
    const osgbindem::RasterLook look = _source.layer().members().front().file->look();
    if (look.missing == look.posts) throw Failure("no heights in \"" + dem + "\", only missing data");
}

core::Interval Terrain::findHeights(const TileId& tile) {
    core::Interval& heights = _heights[level(tile)][place(tile)];
    if (tile.level == deepestLevel()) return heights = range(tile);
    heights = core::Interval::none();
    for (const TileId& child : tile.children()) heights = heights.united(findHeights(child));
    return heights;
}

core::Interval Terrain::range(const TileId& tile) {
    core::Interval range = core::Interval::none();
    if (!_source.addRange(tile.rect(), range)) range.expandBy(0.0);
    return {std::max(range.lower, 0.0), std::max(range.upper, 0.0)};
}

core::GeodeticBin Terrain::bin(const TileId& tile) const {
    const osgbindem::RectDeg rect = tile.rect();
    return core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, heights(tile));
}

osgbindem::RectDeg Terrain::extent() const noexcept {
    if (_source.grid().isGlobal()) return {-180.0, -90.0, 180.0, 90.0};
    const osgbindem::RectDeg extent = _source.grid().extent();
    return {extent.west, std::max(extent.south, -90.0), extent.east, std::min(extent.north, 90.0)};
}

double Terrain::height(const osgbindem::PositionDeg& position) {
    const auto found = _source.height(position);
    return std::max(found ? found->metres : 0.0, 0.0);
}

core::Geodetic Terrain::onSurface(const core::Geodetic& position) {
    return {position.latitude, position.longitude,
            height({position.latitude * kDegreesPerRadian, position.longitude * kDegreesPerRadian})};
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Terrain.h"

#include "Angles.h"
#include "Failure.h"

#include <osg/CoordinateSystemNode>

#include <algorithm>
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
    : _ellipsoid(wgs84()),
      _source(layerOf(dem)),
      _pyramid(deepestLevel, [this](const TileId& tile) { return range(tile); }) {
    const osgbindem::RasterLook look = _source.layer().members().front().file->look();
    if (look.missing == look.posts) throw Failure("no heights in \"" + dem + "\", only missing data");
}

core::Interval Terrain::range(const TileId& tile) {
    if (tile.level == 0) _source.prefetch(tile.rect());
    osgbindem::HeightRange range;
    if (!_source.addRange(tile.rect(), range)) range.include(0.0);
    return {std::max(range.lower, 0.0), std::max(range.upper, 0.0)};
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

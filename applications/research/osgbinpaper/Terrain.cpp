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

Terrain::Terrain(const std::string& dem, int deepestLevel, double floor, Progress& progress)
    : _ellipsoid(wgs84()),
      _source(layerOf(dem)),
      _floor(floor),
      _pyramid(
          deepestLevel, [this](const TileId& tile) { return range(tile); },
          [&](const TileId& start) {
              const int done = start.y * TileId::kStartColumns + start.x;
              progress.show("heights", static_cast<std::size_t>(done), TileId::kStartColumns * TileId::kStartRows);
              _source.prefetch(start.rect());
          }) {
    const osgbindem::RasterFile& file = *_source.layer().members().front().file;
    if (!file.hasHeights(file.look())) throw Failure("no heights in \"" + dem + "\", only missing data");
}

core::Interval Terrain::range(const TileId& tile) {
    osgbindem::HeightRange range;
    if (!_source.addRange(tile.rect(), range)) range.include(0.0);
    return {std::max(range.lower, _floor), std::max(range.upper, _floor)};
}

osgbindem::RectDeg Terrain::extent() const noexcept {
    if (_source.grid().isGlobal()) return {-180.0, -90.0, 180.0, 90.0};
    const osgbindem::RectDeg extent = _source.grid().extent();
    return {extent.west, std::max(extent.south, -90.0), extent.east, std::min(extent.north, 90.0)};
}

double Terrain::height(const osgbindem::PositionDeg& position) {
    const auto found = _source.height(position);
    return std::max(found ? found->metres : 0.0, _floor);
}

core::Geodetic Terrain::onSurface(const core::Geodetic& position) {
    return {position.latitude, position.longitude,
            height({position.latitude * kDegreesPerRadian, position.longitude * kDegreesPerRadian})};
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemSource.h"
#include "HeightPyramid.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <string>

namespace osgAnalyticBin::paper {

/// The ellipsoid of a default osg::EllipsoidModel.
[[nodiscard]] core::Ellipsoid wgs84();

/// The globe that an elevation raster describes; 0 m where it has no data.
class Terrain final {
public:
    /// Heights below 0 m, those of the sea's floor, are taken for its surface.
    /// Throws: osgbindem::Failure when the raster cannot be read.
    Terrain(const std::string& dem, int deepestLevel);

    [[nodiscard]] const HeightPyramid& pyramid() const noexcept { return _pyramid; }
    [[nodiscard]] const core::Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    /// Where the raster has part; the whole globe for one that goes round it.
    [[nodiscard]] osgbindem::RectDeg extent() const noexcept;

    /// Metres above the ellipsoid, bilinear between posts.
    [[nodiscard]] double height(const osgbindem::PositionDeg& position);

    /// The point of the terrain at a latitude and a longitude in radians; the altitude given is not used.
    [[nodiscard]] core::Geodetic onSurface(const core::Geodetic& position);

    /// Makes height() fast within the rectangle.
    void prefetch(const osgbindem::RectDeg& rect) { _source.prefetch(rect); }

private:
    [[nodiscard]] core::Interval range(const TileId& tile);

    core::Ellipsoid _ellipsoid;
    osgbindem::DemSource _source;
    HeightPyramid _pyramid;
};

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterFile.h"
#include "Settings.h"
#include "TileLayout.h"

#include <algorithm>
#include <iosfwd>
#include <memory>
#include <optional>
#include <vector>

namespace osgbindem {

/// The band inside a raster's border over which it gives way to coarser rasters below it.
///
/// No band is where another raster goes on beyond the border: one that is as fine or finer, or one that only meets this
/// one.
class BlendBand final {
public:
    /// A raster without a band.
    BlendBand() = default;

    /// `width`: metres, 0 for none; without it, the distance between posts of the finest coarser raster below, but no
    /// more than an eighth of the raster's shorter side. `radius`: of the globe, in metres.
    BlendBand(const RasterGrid& grid, const std::vector<RasterGrid>& all, const std::optional<double>& width,
              double radius);

    /// The raster's share of the height, from 0 at the border to 1 at the end of the band.
    [[nodiscard]] double share(const PositionDeg& position) const noexcept;

    /// Whether the band may reach into the rectangle.
    [[nodiscard]] bool touches(const RectDeg& rect) const noexcept;

    /// Writes all that shares depend on.
    void describe(std::ostream& out) const;

private:
    [[nodiscard]] bool continues(const PositionDeg& beyond, const PositionDeg& position) const noexcept;

    double _width = 0.0;
    double _metresPerDegree = 0.0;
    RasterGrid _grid;
    /// Those that have a part beyond its border.
    std::vector<RasterGrid> _others;
};

/// An elevation raster in degrees of the globe. GDAL warps what is in another system, at its own spacing or to the
/// posts of tiles that are as fine, which then have GDAL's own bilinear values. Not for use by several threads.
class RasterLayer final {
public:
    using Layers = std::vector<std::unique_ptr<RasterLayer>>;

    /// Opens all elevation rasters of the command line; finest first, of equally fine ones the one named first.
    /// For tiles of the layout where there is one: then of the overviews that are as fine, where settings allow them,
    /// and warped to posts of tiles. Throws Failure.
    [[nodiscard]] static Layers elevationOf(const Settings& settings, const TileLayout* layout);

    /// `tileCells`: warps to posts of tiles with so many cells. Throws Failure.
    RasterLayer(RasterFile file, std::optional<int> tileCells);

    [[nodiscard]] const RasterFile& file() const noexcept { return _file; }
    [[nodiscard]] GDALDataset& dataset() const noexcept { return _warped ? *_warped : *_file.dataset; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _grid; }
    /// Between posts of the file, the smaller distance.
    [[nodiscard]] double spacingDeg() const noexcept { return std::min(_file.eastDeg, _file.northDeg); }
    /// The band in which the raster's heights are blended with coarser ones.
    [[nodiscard]] const BlendBand& band() const noexcept { return _band; }

private:
    RasterFile _file;
    GdalDataset _warped;
    RasterGrid _grid;
    BlendBand _band;
};

}  // namespace osgbindem

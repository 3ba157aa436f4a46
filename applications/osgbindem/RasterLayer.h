// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterFile.h"
#include "Settings.h"
#include "TileLayout.h"

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// The band inside a raster's border over which it gives way to coarser rasters below it.
///
/// No band is where another raster goes on: one that is as fine or finer, or one that only meets this one.
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
    [[nodiscard]] bool touches(const RectDeg& rect) const noexcept { return metresTo(rect) <= _width; }

    /// Writes all that shares depend on.
    void describe(std::ostream& out) const;

private:
    /// To the nearest open part of the border; infinite without one.
    [[nodiscard]] double metresTo(const RectDeg& rect) const noexcept;
    /// Adds the open parts of the southern and the northern border, or of the western and the eastern one.
    void addEdges(const RasterGrid& grid, const std::vector<RasterGrid>& all, bool areParallels);

    double _width = 0.0;
    double _metresPerDegree = 0.0;
    /// Parts of the border, as rectangles of no width or no height. Longitudes are those of the raster.
    std::vector<RectDeg> _edges;
};

/// Rasters of one grid that meet, as one raster in degrees of the globe. GDAL makes it: they are a mosaic, and what is
/// not in degrees of the globe is warped, at its own spacing or to the posts of tiles that are as fine, which then have
/// GDAL's own bilinear values. Of rasters with data at the same place the one named first counts. Not for use by
/// several threads.
class RasterLayer final {
public:
    using Layers = std::vector<std::unique_ptr<RasterLayer>>;

    /// Opens all elevation rasters of the command line; finest layers first, of equally fine ones the one named first.
    /// For tiles of the layout where there is one: then of the overviews that are as fine, where settings allow them,
    /// and warped to posts of tiles. Throws Failure.
    [[nodiscard]] static Layers elevationOf(const Settings& settings, const TileLayout* layout);
    /// The same of all images. Throws Failure.
    [[nodiscard]] static Layers imagesOf(const Settings& settings);

    /// A raster, its number on the command line and the grid of the layer's posts within it.
    struct Member {
        std::size_t number = 0;
        RasterFile file;
        RasterGrid grid;
        BlendBand band;
    };
    using Members = std::vector<Member>;

    /// `tileCells`: warps to posts of tiles with so many cells. Throws Failure.
    RasterLayer(Members members, std::optional<int> tileCells);

    [[nodiscard]] const Members& members() const noexcept { return _members; }
    [[nodiscard]] const std::string& path() const noexcept { return first().input.path; }
    [[nodiscard]] const std::string& vertical() const noexcept { return first().vertical; }

    [[nodiscard]] GDALDataset& dataset() const noexcept;
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _grid; }
    /// The distance between posts of the finest raster.
    [[nodiscard]] double spacingDeg() const noexcept { return _spacingDeg; }

    /// The sum of the areas in square degrees that the layer's rasters have in common with the rectangle.
    [[nodiscard]] double overlap(const RectDeg& rect) const noexcept;

    /// The layer's share of heights or colours, less than 1 in the bands at its rasters' borders; and whether a band
    /// may reach into the rectangle.
    [[nodiscard]] double share(const PositionDeg& position) const noexcept;
    [[nodiscard]] bool isBlendedIn(const RectDeg& rect) const noexcept;

private:
    [[nodiscard]] static Layers layersOf(const Settings& settings, const std::vector<DemInput>& rasters,
                                         bool areElevation, double spacingDeg, std::optional<int> tileCells);
    [[nodiscard]] const RasterFile& first() const noexcept { return _members.front().file; }
    void warp(std::optional<int> tileCells);

    Members _members;
    /// Of several members, and of what is warped.
    GdalDataset _mosaic;
    GdalDataset _warped;
    double _spacingDeg;
    RasterGrid _grid;
};

}  // namespace osgbindem

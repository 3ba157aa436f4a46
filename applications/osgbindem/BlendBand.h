// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <iosfwd>
#include <optional>
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

    [[nodiscard]] bool isEmpty() const noexcept { return _edges.empty(); }

    /// The raster's share of the height, from 0 at the border to 1 at the end of the band.
    [[nodiscard]] double share(const PositionDeg& position) const noexcept {
        return _edges.empty() ? 1.0 : shareWithin(position);
    }

    /// Whether the band may reach into the rectangle.
    [[nodiscard]] bool touches(const RectDeg& rect) const noexcept;

    /// Writes all that shares depend on.
    void describe(std::ostream& out) const;

private:
    [[nodiscard]] double shareWithin(const PositionDeg& position) const noexcept;
    /// A part of the border: a rectangle without width or without height. Longitudes are those of the raster.
    void addEdge(const RectDeg& edge, const std::vector<RectDeg>& closed);

    double _width = 0.0;
    double _metresPerDegree = 0.0;
    double _west = 0.0;
    std::vector<RectDeg> _edges;
};

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace osgbindem {

using namespace osgAnalyticBin::tiles;

/// A rectangle of pixels.
struct PixelWindow {
    int column = 0;
    int row = 0;
    int width = 0;
    int height = 0;

    [[nodiscard]] bool contains(int c, int r) const noexcept {
        return c >= column && c < column + width && r >= row && r < row + height;
    }
};

/// A position between posts: the four posts around it and the weights of the second column and the second row.
struct PostCell {
    int west = 0;
    int east = 0;
    int first = 0;
    int second = 0;
    double eastWeight = 0.0;
    double secondWeight = 0.0;
};

/// Where the posts (pixel centres) of a raster in geographic coordinates stand. Longitudes count modulo 360; a raster
/// that goes round the globe has no seam.
class RasterGrid final {
public:
    RasterGrid() = default;
    /// The geotransform in GDAL's order, without rotation and with columns running eastward; rows may run either way.
    RasterGrid(const std::array<double, 6>& geoTransform, int width, int height) noexcept;

    [[nodiscard]] int columns() const noexcept { return _width; }
    [[nodiscard]] int rows() const noexcept { return _height; }

    /// True when the raster goes round the globe.
    [[nodiscard]] bool isGlobal() const noexcept { return _isGlobal; }

    /// The smaller of the two distances between posts.
    [[nodiscard]] double resolutionDeg() const noexcept { return std::min(_dx, std::abs(_dy)); }
    /// The larger one.
    [[nodiscard]] double coarsestDeg() const noexcept { return std::max(_dx, std::abs(_dy)); }

    /// The area of the pixels; may pass +-90 by half a pixel.
    [[nodiscard]] RectDeg extent() const noexcept;

    /// The part of the rectangle's area that the raster covers, in square degrees.
    [[nodiscard]] double overlap(const RectDeg& rect) const noexcept { return extent().overlap(rect); }

    [[nodiscard]] bool covers(const RectDeg& rect) const noexcept;

    /// Returns: nullopt outside the raster. In the outer half of the border pixels the border posts count on.
    [[nodiscard]] std::optional<PostCell> locate(const PositionDeg& position) const noexcept;

    /// All posts whose bilinear footprint touches the rectangle, as at most three windows.
    [[nodiscard]] std::vector<PixelWindow> touching(const RectDeg& rect) const { return windows(rect, -kSnap, 0); }

    /// The posts that lie within the rectangle and not on its edge.
    [[nodiscard]] std::vector<PixelWindow> inside(const RectDeg& rect) const { return windows(rect, kSnap, 1); }

    [[nodiscard]] PositionDeg position(int column, int row) const noexcept {
        return {_firstLatitude + row * _dy, _firstLongitude + column * _dx};
    }

    [[nodiscard]] double columnOf(double longitudeDeg) const noexcept { return (longitudeDeg - _firstLongitude) / _dx; }
    [[nodiscard]] double rowOf(double latitudeDeg) const noexcept { return (latitudeDeg - _firstLatitude) / _dy; }

private:
    // Positions closer than this to a post, in pixels, are on it: geotransforms carry about nine digits.
    static constexpr double kSnap = 1e-6;

    [[nodiscard]] std::vector<PixelWindow> windows(const RectDeg& rect, double snap, int inward) const;

    int _width = 1;
    int _height = 1;
    double _dx = 1.0;
    double _dy = -1.0;
    double _firstLongitude = 0.0;
    double _firstLatitude = 0.0;
    bool _isGlobal = false;
};

}  // namespace osgbindem

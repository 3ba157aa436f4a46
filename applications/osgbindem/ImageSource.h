// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GdalRaster.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgbindem {

/// A colour over others.
struct Cover {
    /// Red, green, blue, 0 to 255.
    std::array<double, 3> colour{};
    /// 0: what is below is seen, 1: it is not.
    double alpha = 0.0;
};

/// One image. Not for use by several threads: each has its own.
class ImageSource final {
public:
    /// Throws Failure.
    ImageSource(const std::string& path, bool isWgs84);

    [[nodiscard]] const RasterGrid& grid() const noexcept { return _raster.grid(); }

    /// Reads the part that touches the rectangle, reduced to so many pixels along a side at most, in place of the one
    /// before. Returns: whether there is any. Throws Failure.
    bool load(const RectDeg& rect, int mostPixels);

    /// Bilinear between pixels of the part that is loaded. Outside, and where pixels are transparent, masked or nodata,
    /// nothing is covered.
    [[nodiscard]] Cover sample(const PositionDeg& position) const noexcept;

private:
    /// Part of the image; four bytes a pixel, the last one its alpha.
    struct Patch {
        PixelWindow window;
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> pixels;

        [[nodiscard]] const std::uint8_t* pixel(int column, int row) const noexcept;
    };

    [[nodiscard]] Patch read(const PixelWindow& window, int mostPixels) const;
    void readBand(GDALRasterBand& band, const Patch& patch, std::uint8_t* target, int bytesApart) const;
    void readAlpha(Patch& patch) const;
    [[nodiscard]] const std::uint8_t* find(int column, int row) const noexcept;

    GdalRaster _raster;
    std::vector<Patch> _patches;
};

}  // namespace osgbindem

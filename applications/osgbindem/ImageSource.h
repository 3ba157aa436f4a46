// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GdalRaster.h"
#include "HeightGrid.h"
#include "Hypsometry.h"

#include <osg/Image>

#include <string>
#include <vector>

namespace osgbindem {

/// The image that is draped over the terrain. Not for use by several threads: each has its own.
class ImageSource final {
public:
    /// Throws Failure.
    ImageSource(const std::string& path, bool isWgs84);

    /// The texture of a tile; its outer texels' middles lie on the tile's edges, so that neighbours meet in the same
    /// colours. Where the image has nothing, the colours are those of the heights.
    [[nodiscard]] osg::ref_ptr<osg::Image> texture(const HeightGrid& heights);

    /// Texels along the edge of a tile's texture: no more than the image has, a power of two.
    [[nodiscard]] int textureSize(int level) const noexcept;

private:
    /// Part of the image, reduced to about the size of a texture; four bytes a pixel, the last one a mask.
    struct Patch {
        PixelWindow window;
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> pixels;

        [[nodiscard]] const std::uint8_t* pixel(int column, int row) const noexcept;
    };

    [[nodiscard]] Patch read(const PixelWindow& window, int mostPixels) const;
    [[nodiscard]] bool sample(const PositionDeg& position, Rgb& colour) const noexcept;
    [[nodiscard]] const std::uint8_t* find(int column, int row) const noexcept;

    GdalRaster _raster;
    std::vector<Patch> _patches;
};

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterFile.h"
#include "Settings.h"
#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osg/Image>

#include <cstdint>
#include <vector>

namespace osgbindem {

/// All images that are draped over the terrain as one: at each position the finest image that has a pixel there, and
/// the colours of the relief where none has. GDAL warps them. Of equally fine images the one named first counts. Not
/// for use by several threads: each has its own.
class ImageMosaic final {
public:
    /// Throws Failure.
    explicit ImageMosaic(const Settings& settings) : _images(imagesOf(settings)) {}

    /// All images of the command line, finest first. Throws Failure.
    [[nodiscard]] static std::vector<RasterFile> imagesOf(const Settings& settings);

    /// Texels along the edge of a tile's texture, a power of two: no more than the finest image there has, nor fewer
    /// than the tile has cells where images leave a part of it to the relief. Returns: 0 where there is no image.
    [[nodiscard]] int textureSize(const TileId& tile, int cells) const noexcept;

    /// The texture of a tile; its outer texels' middles lie on the tile's edges, so that neighbours meet in the same
    /// colours. Requires: `grid` has the size of the texture, which is not 0. Throws Failure.
    [[nodiscard]] osg::ref_ptr<osg::Image> texture(const TileId& tile, const osgAnalyticBin::TerrainGrid& grid);

private:
    /// What all images have of a tile, row by row from the north: red, green, blue and alpha.
    [[nodiscard]] std::vector<std::uint8_t> warped(const RectDeg& rect, int size);

    std::vector<RasterFile> _images;
};

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterLayer.h"
#include "Settings.h"
#include "TerrainGrid.h"
#include "TileLayout.h"

#include <osg/Image>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace osgbindem {

/// A colour over others.
struct Cover {
    /// Red, green, blue, 0 to 255.
    std::array<double, 3> colour{};
    /// 0: what is below is seen, 1: it is not.
    double alpha = 0.0;
};

/// One layer of images. Not for use by several threads: each has its own.
class ImageSource final {
public:
    explicit ImageSource(std::unique_ptr<RasterLayer> layer) : _layer(std::move(layer)) {}

    [[nodiscard]] const RasterLayer& layer() const noexcept { return *_layer; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _layer->grid(); }

    /// Whether an image of the layer has a part in the rectangle, and whether one covers it.
    [[nodiscard]] bool overlaps(const RectDeg& rect) const noexcept;
    [[nodiscard]] bool covers(const RectDeg& rect) const noexcept;

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
    [[nodiscard]] const std::uint8_t* find(int column, int row) const noexcept;

    std::unique_ptr<RasterLayer> _layer;
    std::vector<Patch> _patches;
};

/// All images that are draped over the terrain as one: at each position the finest image that has a pixel there, its
/// border blended with coarser ones, and the colours of the relief where none has.
/// Of equally fine images the one named first counts. Not for use by several threads: each has its own.
class ImageMosaic final {
public:
    /// Throws Failure.
    explicit ImageMosaic(const Settings& settings);

    /// Texels along the edge of a tile's texture, a power of two: no more than the finest image there has, nor fewer
    /// than the tile has cells where images leave a part of it to the relief. Returns: 0 where there is no image.
    [[nodiscard]] int textureSize(const TileId& tile, int cells) const noexcept;

    /// The texture of a tile; its outer texels' middles lie on the tile's edges, so that neighbours meet in the same
    /// colours. Requires: `grid` has the size of the texture, which is not 0. Throws Failure.
    [[nodiscard]] osg::ref_ptr<osg::Image> texture(const TileId& tile, const osgAnalyticBin::TerrainGrid& grid);

private:
    /// Of the layers with a part in the tile from this one on, finest first.
    [[nodiscard]] Cover sample(std::size_t first, const PositionDeg& position) const noexcept;

    std::vector<std::unique_ptr<ImageSource>> _layers;
    std::vector<const ImageSource*> _loaded;
};

}  // namespace osgbindem

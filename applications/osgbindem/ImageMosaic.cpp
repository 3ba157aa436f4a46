// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ImageMosaic.h"

#include "RasterLayer.h"
#include "Tile.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace osgbindem {

/// A colour over others.
struct Cover {
    /// Red, green, blue, 0 to 255.
    glm::dvec3 colour{0.0};
    /// 0: what is below is seen, 1: it is not.
    double alpha = 0.0;

    /// With this alpha over what is below.
    [[nodiscard]] Cover over(double own, const Cover& below) const {
        Cover cover;
        cover.alpha = own + (1.0 - own) * below.alpha;
        cover.colour = below.colour + own / cover.alpha * (colour - below.colour);
        return cover;
    }
};

/// One layer of images. Not for use by several threads: each has its own.
class ImageSource final {
public:
    explicit ImageSource(std::unique_ptr<RasterLayer> layer) : _layer(std::move(layer)) {}

    [[nodiscard]] const RasterLayer& layer() const noexcept { return *_layer; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _layer->grid(); }

    /// Whether the images of the layer cover it.
    [[nodiscard]] bool covers(const RectDeg& rect) const noexcept {
        constexpr double kRounding = 1e-6;
        const double area = (rect.east - rect.west) * (rect.north - rect.south);
        return grid().covers(rect) && _layer->overlap(rect) >= (1.0 - kRounding) * area;
    }

    /// Reads the part that touches the rectangle, reduced to so many pixels along a side at most, in place of the one
    /// before. Returns: whether there is any. Throws Failure.
    bool load(const RectDeg& rect, int mostPixels) {
        _patches.clear();
        for (const PixelWindow& window : grid().touching(rect)) {
            Patch patch{window, std::min(window.width, mostPixels), std::min(window.height, mostPixels), {}};
            patch.pixels.resize(4 * static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height));
            GDALRasterIOExtraArg extra;
            INIT_RASTERIO_EXTRA_ARG(extra);
            extra.eResampleAlg = GRIORA_Average;
            const CPLErr error = _layer->dataset().RasterIO(
                GF_Read, window.column, window.row, window.width, window.height, patch.pixels.data(), patch.width,
                patch.height, GDT_Byte, 4, nullptr, 4, GSpacing{4} * patch.width, 1, &extra);
            if (error != CE_None) throw Failure("cannot read \"" + _layer->path() + "\": " + gdalMessage());
            _patches.push_back(std::move(patch));
        }
        return !_patches.empty();
    }

    /// Bilinear between pixels of the part that is loaded. Outside, and where pixels are transparent, masked or nodata,
    /// nothing is covered.
    [[nodiscard]] Cover sample(const PositionDeg& position) const noexcept {
        constexpr std::uint8_t kOpaque = 255;
        Cover cover;
        const auto cell = grid().locate(position);
        if (!cell) return cover;
        const double u = cell->eastWeight;
        const double v = cell->secondWeight;
        const std::array<const std::uint8_t*, 4> pixels{find(cell->west, cell->first), find(cell->east, cell->first),
                                                        find(cell->west, cell->second), find(cell->east, cell->second)};
        const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
        bool isOpaque = true;
        for (std::size_t i = 0; i < 4; ++i) {
            if (weights[i] == 0.0) continue;
            const std::uint8_t alpha = pixels[i] == nullptr ? 0 : pixels[i][3];
            isOpaque = isOpaque && alpha == kOpaque;
            if (alpha == 0) continue;
            const double weight = alpha == kOpaque ? weights[i] : weights[i] * alpha / kOpaque;
            cover.alpha += weight;
            cover.colour += weight * glm::dvec3(pixels[i][0], pixels[i][1], pixels[i][2]);
        }
        if (isOpaque) {
            cover.alpha = 1.0;  // a sum of weights may miss it by its rounding
        } else if (cover.alpha > 0.0) {
            cover.colour /= cover.alpha;
        }
        return cover;
    }

private:
    /// Part of the image; four bytes a pixel, the last one its alpha.
    struct Patch {
        PixelWindow window;
        int width = 0;
        int height = 0;
        std::vector<std::uint8_t> pixels;
    };

    [[nodiscard]] const std::uint8_t* find(int column, int row) const noexcept {
        // divisions would take most of the time where nothing is reduced
        const auto reduced = [](int place, int size, int from) {
            return size == from ? place : static_cast<int>(static_cast<std::int64_t>(place) * size / from);
        };
        for (const Patch& patch : _patches) {
            if (!patch.window.contains(column, row)) continue;
            const int x = reduced(column - patch.window.column, patch.width, patch.window.width);
            const int y = reduced(row - patch.window.row, patch.height, patch.window.height);
            return patch.pixels.data() + 4 * (static_cast<std::ptrdiff_t>(y) * patch.width + x);
        }
        return nullptr;
    }

    std::unique_ptr<RasterLayer> _layer;
    std::vector<Patch> _patches;
};

namespace {

/// The colours of the relief between the posts of a tile.
class Relief {
public:
    explicit Relief(const osgAnalyticBin::TerrainGrid& grid) : _cells(grid.cells), _colours(reliefColours(grid)) {}

    /// At a place within the tile, both shares from 0 to 1.
    [[nodiscard]] Cover at(double eastShare, double northShare) const {
        const double x = eastShare * _cells;
        const double y = northShare * _cells;
        const int column = std::min(static_cast<int>(x), _cells - 1);
        const int row = std::min(static_cast<int>(y), _cells - 1);
        const double u = x - column;
        const double v = y - row;
        const auto post = [&](int east, int north) {
            const auto i = static_cast<std::size_t>((row + north) * (_cells + 1) + column + east);
            const osg::Vec4ub& colour = (*_colours)[i];
            return glm::dvec3(colour.r(), colour.g(), colour.b());
        };
        return {glm::mix(glm::mix(post(0, 0), post(1, 0), u), glm::mix(post(0, 1), post(1, 1), u), v), 1.0};
    }

private:
    int _cells;
    osg::ref_ptr<const osg::Vec4ubArray> _colours;
};

}  // namespace

ImageMosaic::ImageMosaic(const Settings& settings) {
    for (auto& layer : RasterLayer::imagesOf(settings)) {
        _layers.push_back(std::make_unique<ImageSource>(std::move(layer)));
    }
}

ImageMosaic::~ImageMosaic() = default;

int ImageMosaic::textureSize(const TileId& tile, int cells) const noexcept {
    const RectDeg rect = tile.rect();
    const ImageSource* finest = nullptr;
    bool isCovered = false;
    for (const auto& layer : _layers) {
        if (!finest && layer->layer().overlap(rect) > 0.0) finest = layer.get();
        isCovered = isCovered || layer->covers(rect);
    }
    if (!finest) return 0;
    const double pixels = std::ldexp(TileLayout::kStartTileDeg, -tile.level) / finest->grid().resolutionDeg();
    const double wanted = isCovered ? pixels : std::max(pixels, static_cast<double>(cells));
    constexpr int kSmallest = 16;
    constexpr int kLargest = 256;
    int size = kSmallest;
    while (size < kLargest && size < wanted) size *= 2;
    return size;
}

Cover ImageMosaic::sample(std::size_t first, const PositionDeg& position) const noexcept {
    for (std::size_t i = first; i < _loaded.size(); ++i) {
        const Cover own = _loaded[i]->sample(position);
        if (own.alpha == 0.0) continue;
        const double share = _loaded[i]->layer().share(position);
        if (own.alpha == 1.0 && share == 1.0) return own;
        const Cover below = sample(i + 1, position);
        // In its band an image gives way to coarser images, and not to the relief.
        return own.over(own.alpha * (1.0 - (1.0 - share) * below.alpha), below);
    }
    return {};
}

osg::ref_ptr<osg::Image> ImageMosaic::texture(const TileId& tile, const osgAnalyticBin::TerrainGrid& grid) {
    const RectDeg rect = tile.rect();
    const int size = grid.textureSize;
    _loaded.clear();
    for (const auto& layer : _layers) {
        if (layer->load(rect, 2 * size)) _loaded.push_back(layer.get());
    }
    std::optional<Relief> relief;
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    unsigned char* target = image->data();
    for (int row = 0; row < size; ++row) {
        const double northShare = static_cast<double>(row) / (size - 1);
        const double latitudeDeg = rect.south + northShare * (rect.north - rect.south);
        for (int column = 0; column < size; ++column) {
            const double eastShare = static_cast<double>(column) / (size - 1);
            Cover cover = sample(0, {latitudeDeg, rect.west + eastShare * (rect.east - rect.west)});
            if (cover.alpha < 1.0) {
                if (!relief) relief.emplace(grid);
                cover = cover.over(cover.alpha, relief->at(eastShare, northShare));
            }
            for (glm::length_t c = 0; c < 3; ++c) *target++ = static_cast<std::uint8_t>(cover.colour[c] + 0.5);
        }
    }
    return image;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ImageMosaic.h"

#include "TileGeometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgbindem {

namespace {

constexpr int kSmallest = 16;
constexpr int kLargest = 256;

/// The top with this alpha over what is below.
Cover over(const Cover& top, double alpha, const Cover& below) {
    Cover cover;
    cover.alpha = alpha + (1.0 - alpha) * below.alpha;
    const double share = alpha / cover.alpha;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        cover.colour[channel] = below.colour[channel] + share * (top.colour[channel] - below.colour[channel]);
    }
    return cover;
}

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
        const auto post = [&](int east, int north, unsigned int channel) {
            return static_cast<double>(
                (*_colours)[static_cast<std::size_t>((row + north) * (_cells + 1) + column + east)][channel]);
        };
        Cover cover;
        cover.alpha = 1.0;
        for (unsigned int c = 0; c < 3; ++c) {
            cover.colour[c] = (1.0 - v) * ((1.0 - u) * post(0, 0, c) + u * post(1, 0, c)) +
                              v * ((1.0 - u) * post(0, 1, c) + u * post(1, 1, c));
        }
        return cover;
    }

private:
    int _cells;
    osg::ref_ptr<const osg::Vec4ubArray> _colours;
};

}  // namespace

ImageMosaic::ImageMosaic(const Settings& settings) {
    for (const std::string& path : settings.images) {
        _layers.push_back({std::make_unique<ImageSource>(path, settings.isWgs84), {}});
    }
    std::stable_sort(_layers.begin(), _layers.end(), [](const Layer& a, const Layer& b) {
        return a.image->grid().resolutionDeg() < b.image->grid().resolutionDeg();
    });
    std::vector<RasterGrid> grids;
    for (const Layer& layer : _layers) grids.push_back(layer.image->grid());
    for (Layer& layer : _layers) {
        layer.band = BlendBand(layer.image->grid(), grids, settings.blend, settings.ellipsoid.equatorialRadius());
    }
}

int ImageMosaic::textureSize(const TileId& tile, int cells) const noexcept {
    const RectDeg rect = tile.rect();
    const Layer* finest = nullptr;
    bool isCovered = false;
    for (const Layer& layer : _layers) {
        if (!finest && layer.image->grid().overlap(rect) > 0.0) finest = &layer;
        isCovered = isCovered || layer.image->grid().covers(rect);
    }
    if (!finest) return 0;
    const double pixels = std::ldexp(TileLayout::kStartTileDeg, -tile.level) / finest->image->grid().resolutionDeg();
    const double wanted = isCovered ? pixels : std::max(pixels, static_cast<double>(cells));
    int size = kSmallest;
    while (size < kLargest && size < wanted) size *= 2;
    return size;
}

Cover ImageMosaic::sample(std::size_t first, const PositionDeg& position) const noexcept {
    for (std::size_t i = first; i < _loaded.size(); ++i) {
        const Cover own = _loaded[i]->image->sample(position);
        if (own.alpha == 0.0) continue;
        const double share = _loaded[i]->band.share(position);
        if (own.alpha == 1.0 && share == 1.0) return own;
        const Cover below = sample(i + 1, position);
        // In its band an image gives way to coarser images, and not to the relief.
        return over(own, own.alpha * (1.0 - (1.0 - share) * below.alpha), below);
    }
    return {};
}

osg::ref_ptr<osg::Image> ImageMosaic::texture(const TileId& tile, const osgAnalyticBin::TerrainGrid& grid) {
    const RectDeg rect = tile.rect();
    const int size = grid.textureSize;
    _loaded.clear();
    for (const Layer& layer : _layers) {
        if (layer.image->load(rect, 2 * size)) _loaded.push_back(&layer);
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
                cover = over(cover, cover.alpha, relief->at(eastShare, northShare));
            }
            for (const double channel : cover.colour) *target++ = static_cast<std::uint8_t>(channel + 0.5);
        }
    }
    return image;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ImageSource.h"

#include "Failure.h"

#include <algorithm>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

constexpr std::uint8_t kOpaque = 255;

RasterOptions optionsFor(const std::string& path, bool isWgs84) {
    RasterOptions options;
    options.path = path;
    options.isWgs84 = isWgs84;
    options.isElevation = false;
    return options;
}

bool isColour(GDALDataset& dataset) {
    return dataset.GetRasterCount() >= 3;
}

}  // namespace

ImageSource::ImageSource(const std::string& path, bool isWgs84) : _raster(optionsFor(path, isWgs84)) {}

const std::uint8_t* ImageSource::Patch::pixel(int column, int row) const noexcept {
    // divisions would take most of the time where nothing is reduced
    const auto reduced = [](int place, int size, int from) {
        return size == from ? place : static_cast<int>(static_cast<std::int64_t>(place) * size / from);
    };
    const int x = reduced(column - window.column, width, window.width);
    const int y = reduced(row - window.row, height, window.height);
    return pixels.data() + 4 * (static_cast<std::ptrdiff_t>(y) * width + x);
}

bool ImageSource::load(const RectDeg& rect, int mostPixels) {
    _patches.clear();
    for (const PixelWindow& window : grid().touching(rect)) _patches.push_back(read(window, mostPixels));
    return !_patches.empty();
}

ImageSource::Patch ImageSource::read(const PixelWindow& window, int mostPixels) const {
    GDALDataset& dataset = _raster.dataset();
    Patch patch{window, std::min(window.width, mostPixels), std::min(window.height, mostPixels), {}};
    patch.pixels.resize(4 * static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height), kOpaque);
    for (int channel = 0; channel < 3; ++channel) {
        readBand(*dataset.GetRasterBand(isColour(dataset) ? channel + 1 : 1), patch, patch.pixels.data() + channel, 4);
    }
    readAlpha(patch);
    return patch;
}

void ImageSource::readBand(GDALRasterBand& band, const Patch& patch, std::uint8_t* target, int bytesApart) const {
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.eResampleAlg = GRIORA_Average;
    const PixelWindow& window = patch.window;
    const CPLErr error =
        band.RasterIO(GF_Read, window.column, window.row, window.width, window.height, target, patch.width,
                      patch.height, GDT_Byte, bytesApart, static_cast<GSpacing>(bytesApart) * patch.width, &extra);
    if (error != CE_None) throw Failure("cannot read \"" + _raster.path() + "\": " + gdalMessage());
}

void ImageSource::readAlpha(Patch& patch) const {
    GDALDataset& dataset = _raster.dataset();
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    if (first.GetMaskFlags() == GMF_ALL_VALID) return;
    // Where each band has a nodata value of its own, a pixel is missing only when all of its colours are.
    const int bands = isColour(dataset) && first.GetMaskFlags() == GMF_NODATA ? 3 : 1;
    std::vector<std::uint8_t> alpha(patch.pixels.size() / 4);
    std::vector<std::uint8_t> mask(alpha.size());
    for (int band = 1; band <= bands; ++band) {
        readBand(*dataset.GetRasterBand(band)->GetMaskBand(), patch, mask.data(), 1);
        for (std::size_t i = 0; i < mask.size(); ++i) alpha[i] = std::max(alpha[i], mask[i]);
    }
    for (std::size_t i = 0; i < alpha.size(); ++i) patch.pixels[4 * i + 3] = alpha[i];
}

const std::uint8_t* ImageSource::find(int column, int row) const noexcept {
    for (const Patch& patch : _patches) {
        if (patch.window.contains(column, row)) return patch.pixel(column, row);
    }
    return nullptr;
}

Cover ImageSource::sample(const PositionDeg& position) const noexcept {
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
        for (std::size_t channel = 0; channel < 3; ++channel) cover.colour[channel] += weight * pixels[i][channel];
    }
    if (isOpaque) {
        cover.alpha = 1.0;  // a sum of weights may miss it by its rounding
    } else if (cover.alpha > 0.0) {
        for (double& channel : cover.colour) channel /= cover.alpha;
    }
    return cover;
}

}  // namespace osgbindem

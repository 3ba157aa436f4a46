// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ImageSource.h"

#include "Failure.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

constexpr int kSmallest = 16;
constexpr int kLargest = 256;

RasterOptions optionsFor(const std::string& path, bool isWgs84) {
    RasterOptions options;
    options.path = path;
    options.isWgs84 = isWgs84;
    options.isElevation = false;
    return options;
}

/// The height at a place within the tile, both shares from 0 to 1.
double heightAt(const HeightGrid& heights, double eastShare, double northShare) {
    const double x = eastShare * heights.cells();
    const double y = northShare * heights.cells();
    const int column = std::min(static_cast<int>(x), heights.cells() - 1);
    const int row = std::min(static_cast<int>(y), heights.cells() - 1);
    const double u = x - column;
    const double v = y - row;
    return (1.0 - v) * ((1.0 - u) * heights.at(column, row) + u * heights.at(column + 1, row)) +
           v * ((1.0 - u) * heights.at(column, row + 1) + u * heights.at(column + 1, row + 1));
}

}  // namespace

ImageSource::ImageSource(const std::string& path, bool isWgs84) : _raster(optionsFor(path, isWgs84)) {}

int ImageSource::textureSize(int level) const noexcept {
    const double pixels = std::ldexp(TileLayout::kStartTileDeg, -level) / _raster.grid().resolutionDeg();
    int size = kSmallest;
    while (size < kLargest && size < pixels) size *= 2;
    return size;
}

const std::uint8_t* ImageSource::Patch::pixel(int column, int row) const noexcept {
    // divisions would take most of the time where nothing is reduced
    const auto reduced = [](int place, int size, int from) {
        return size == from ? place : static_cast<int>(static_cast<std::int64_t>(place) * size / from);
    };
    const int x = reduced(column - window.column, width, window.width);
    const int y = reduced(row - window.row, height, window.height);
    return pixels.data() + 4 * (static_cast<std::ptrdiff_t>(y) * width + x);
}

ImageSource::Patch ImageSource::read(const PixelWindow& window, int mostPixels) const {
    GDALDataset& dataset = _raster.dataset();
    Patch patch{window, std::min(window.width, mostPixels), std::min(window.height, mostPixels), {}};
    patch.pixels.resize(4 * static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height), 255);
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.eResampleAlg = GRIORA_Average;
    const bool isColour = dataset.GetRasterCount() >= 3;
    for (int channel = 0; channel < 4; ++channel) {
        GDALRasterBand* band =
            channel == 3 ? dataset.GetRasterBand(1)->GetMaskBand() : dataset.GetRasterBand(isColour ? channel + 1 : 1);
        if (channel == 3) extra.eResampleAlg = GRIORA_NearestNeighbour;
        const CPLErr error = band->RasterIO(GF_Read, window.column, window.row, window.width, window.height,
                                            patch.pixels.data() + channel, patch.width, patch.height, GDT_Byte, 4,
                                            4 * static_cast<GSpacing>(patch.width), &extra);
        if (error != CE_None) throw Failure("cannot read \"" + _raster.path() + "\": " + gdalMessage());
    }
    return patch;
}

const std::uint8_t* ImageSource::find(int column, int row) const noexcept {
    for (const Patch& patch : _patches) {
        if (patch.window.contains(column, row)) return patch.pixel(column, row);
    }
    return nullptr;
}

bool ImageSource::sample(const PositionDeg& position, Rgb& colour) const noexcept {
    const auto cell = _raster.grid().locate(position);
    if (!cell) return false;
    const double u = cell->eastWeight;
    const double v = cell->secondWeight;
    const std::array<const std::uint8_t*, 4> pixels{find(cell->west, cell->first), find(cell->east, cell->first),
                                                    find(cell->west, cell->second), find(cell->east, cell->second)};
    const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        if (weights[i] == 0.0) continue;
        if (pixels[i] == nullptr || pixels[i][3] == 0) return false;
        for (std::size_t channel = 0; channel < 3; ++channel) sum[channel] += weights[i] * pixels[i][channel];
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        colour[channel] = static_cast<std::uint8_t>(sum[channel] + 0.5);
    }
    return true;
}

osg::ref_ptr<osg::Image> ImageSource::texture(const HeightGrid& heights) {
    const RectDeg rect = heights.tile().rect();
    const int size = textureSize(heights.tile().level);
    _patches.clear();
    for (const PixelWindow& window : _raster.grid().touching(rect)) _patches.push_back(read(window, 2 * size));

    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    unsigned char* target = image->data();
    for (int row = 0; row < size; ++row) {
        const double northShare = static_cast<double>(row) / (size - 1);
        const double latitudeDeg = rect.south + northShare * (rect.north - rect.south);
        for (int column = 0; column < size; ++column) {
            const double eastShare = static_cast<double>(column) / (size - 1);
            Rgb colour{};
            if (!sample({latitudeDeg, rect.west + eastShare * (rect.east - rect.west)}, colour)) {
                colour = hypsometricColour(heightAt(heights, eastShare, northShare));
            }
            target = std::copy(colour.begin(), colour.end(), target);
        }
    }
    return image;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ImageMosaic.h"

#include "Tile.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace osgbindem {

namespace {

double spacingOf(const RasterFile& image) {
    return std::min(image.eastDeg, image.northDeg);
}

/// Draws an image over what `target` has already. Throws Failure.
void drape(RasterFile& image, GDALDataset& target) {
    CPLStringList words(CSLTokenizeString("-r bilinear -srcalpha -dstalpha -wo SAMPLE_GRID=YES"));
    if (!image.isPlain) {
        for (const auto& [word, reference] : {std::pair("-s_srs", &image.horizontal), {"-t_srs", &image.target}}) {
            words.AddString(word);
            words.AddString(wktOf(*reference).c_str());
        }
    }
    GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words.List(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(image.dataset.get());
    const bool isDrawn = GDALWarp(nullptr, GDALDataset::ToHandle(&target), 1, &source, options, nullptr) != nullptr;
    GDALWarpAppOptionsFree(options);
    if (!isDrawn) throw Failure("cannot read \"" + image.input.path + "\": " + gdalMessage());
}

/// The colours of the relief between the posts of a tile.
class Relief {
public:
    explicit Relief(const osgAnalyticBin::TerrainGrid& grid) : _cells(grid.cells), _colours(reliefColours(grid)) {}

    /// At a place within the tile, both shares from 0 to 1.
    [[nodiscard]] glm::dvec3 at(double eastShare, double northShare) const {
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
        return glm::mix(glm::mix(post(0, 0), post(1, 0), u), glm::mix(post(0, 1), post(1, 1), u), v);
    }

private:
    int _cells;
    osg::ref_ptr<const osg::Vec4ubArray> _colours;
};

}  // namespace

std::vector<RasterFile> ImageMosaic::imagesOf(const Settings& settings) {
    std::vector<RasterFile> images;
    for (const std::string& path : settings.images) images.emplace_back(settings, DemInput{path}, false, 0.0);
    std::stable_sort(images.begin(), images.end(),
                     [](const auto& a, const auto& b) { return spacingOf(a) < spacingOf(b); });
    return images;
}

int ImageMosaic::textureSize(const TileId& tile, int cells) const noexcept {
    const RectDeg rect = tile.rect();
    const auto isThere = [&](const RasterFile& image) { return image.extent.overlap(rect) > 0.0; };
    const auto finest = std::find_if(_images.begin(), _images.end(), isThere);
    if (finest == _images.end()) return 0;
    constexpr double kRounding = 1e-6;
    const double area = (rect.east - rect.west) * (rect.north - rect.south);
    const bool isCovered = std::any_of(_images.begin(), _images.end(), [&](const RasterFile& image) {
        return image.extent.overlap(rect) >= (1.0 - kRounding) * area;
    });
    const double pixels = std::ldexp(TileLayout::kStartTileDeg, -tile.level) / spacingOf(*finest);
    const double wanted = isCovered ? pixels : std::max(pixels, static_cast<double>(cells));
    constexpr int kSmallest = 16;
    constexpr int kLargest = 256;
    int size = kSmallest;
    while (size < kLargest && size < wanted) size *= 2;
    return size;
}

std::vector<std::uint8_t> ImageMosaic::warped(const RectDeg& rect, int size) {
    // A pole or the end of an image round the globe is within it, not beyond by the last digit.
    constexpr double kInside = 1e-9;
    const double texel = (rect.east - rect.west - 2.0 * kInside) / (size - 1);
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
    const GdalDataset target(driver == nullptr ? nullptr : driver->Create("", size, size, 4, GDT_Byte, nullptr));
    if (!target) throw Failure("no memory for a texture: " + gdalMessage());
    target->GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand);
    for (auto image = _images.rbegin(); image != _images.rend(); ++image) {
        for (const double turn : {-360.0, 0.0, 360.0}) {
            const RectDeg seen = RectDeg{rect.west + turn, rect.south, rect.east + turn, rect.north}.grownBy(texel);
            if (seen.west >= image->extent.east || seen.east <= image->extent.west ||
                image->extent.overlap(seen) == 0.0)
                continue;
            double transform[] = {rect.west + turn + kInside - 0.5 * texel, texel, 0.0,
                                  rect.north - kInside + 0.5 * texel,       0.0,   -texel};
            target->SetGeoTransform(transform);
            drape(*image, *target);
        }
    }
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    if (target->RasterIO(GF_Read, 0, 0, size, size, pixels.data(), size, size, GDT_Byte, 4, nullptr, 4,
                         GSpacing{4} * size, 1, nullptr) != CE_None)
        throw Failure("cannot read a texture: " + gdalMessage());
    return pixels;
}

osg::ref_ptr<osg::Image> ImageMosaic::texture(const TileId& tile, const osgAnalyticBin::TerrainGrid& grid) {
    const int size = grid.textureSize;
    const std::vector<std::uint8_t> pixels = warped(tile.rect(), size);
    std::optional<Relief> relief;
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    unsigned char* texel = image->data();
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const std::uint8_t* pixel = &pixels[4 * static_cast<std::size_t>((size - 1 - row) * size + column)];
            glm::dvec3 colour(pixel[0], pixel[1], pixel[2]);
            if (pixel[3] < 255) {
                if (!relief) relief.emplace(grid);
                const double last = size - 1.0;
                colour = glm::mix(relief->at(column / last, row / last), colour, pixel[3] / 255.0);
            }
            for (glm::length_t c = 0; c < 3; ++c) *texel++ = static_cast<std::uint8_t>(colour[c] + 0.5);
        }
    }
    return image;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterLayer.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ostream>
#include <utility>

namespace osgbindem {

namespace {

/// Columns and rows of posts in degrees that rasters are warped to.
struct Frame {
    /// Holds the area and one post more, none beyond the poles. Its lattice has a post at longitude -180 and latitude
    /// 90, so that it does not depend on what is read.
    Frame(const RectDeg& area, double dx, double dy) {
        constexpr double kRounding = 1e-6;
        const bool isRound = area.east - area.west >= 360.0 - dx;
        if (isRound) dx = 360.0 / std::ceil(360.0 / dx - kRounding);
        const double west = -180.0 - 0.5 * dx;
        const double north = 90.0 + 0.5 * dy;
        const double column = std::floor((area.west - west) / dx) - (isRound ? 0.0 : 1.0);
        const double row = std::max(std::floor((north - area.north) / dy) - 1.0, 0.0);
        columns = isRound ? std::round(360.0 / dx) : std::ceil((area.east - west) / dx) + 1.0 - column;
        rows = std::min(std::ceil((north - area.south) / dy) + 1.0, std::floor(180.0 / dy + 1.0 + kRounding)) - row;
        transform = {west + column * dx, dx, 0.0, north - row * dy, 0.0, -dy};
    }

    GeoTransform transform{};
    double columns;
    double rows;
};

GdalDataset warped(const RasterFile& file, const Frame& frame) {
    constexpr double kMost = std::numeric_limits<int>::max();
    if (!(frame.columns >= 1.0 && frame.rows >= 1.0 && frame.columns < kMost && frame.rows < kMost))
        throw Failure("\"" + file.input.path + "\" is too wide for its spacing; give a part of it, see gdal_translate");
    // Each post is transformed by itself: what is between others would depend on how the raster is divided. Its height
    // is that of its place (XSCALE, YSCALE), not the mean around it where the map's pixels are smaller.
    const GeoTransform& t = frame.transform;
    CPLStringList words(CSLTokenizeString(CPLSPrintf(
        "-of VRT -r bilinear -et 0 -novshift -wo SAMPLE_GRID=YES -te %.17g %.17g %.17g %.17g -ts %.17g %.17g "
        "-srcnodata nan -dstnodata nan -wo XSCALE=1 -wo YSCALE=1",
        t[0], t[3] + frame.rows * t[5], t[0] + frame.columns * t[1], t[3], frame.columns, frame.rows)));
    words.AddString("-t_srs");
    words.AddString(wktOf(file.target).c_str());
    return madeBy<GDALWarpAppOptionsNew, GDALWarpAppOptionsFree>(
        words, "bring \"" + file.input.path + "\" to latitude and longitude", [&](auto* options, int* usageError) {
            GDALDatasetH source = GDALDataset::ToHandle(file.dataset.get());
            return GDALWarp("", nullptr, 1, &source, options, usageError);
        });
}

// Rasters of one resolution have pixel sizes that differ in their last digits.
constexpr double kEquallyFine = 1.01;

double cosine(double latitudeDeg) {
    return std::cos(glm::radians(latitudeDeg));
}

bool isCoarser(const RasterGrid& grid, const RasterGrid& than) {
    return grid.resolutionDeg() > kEquallyFine * than.resolutionDeg();
}

/// Metres; 0 when no coarser raster lies below.
double defaultWidth(const RasterGrid& grid, const std::vector<RasterGrid>& all, double metresPerDegree) {
    constexpr double kLargestPart = 1.0 / 8.0;
    const RectDeg extent = grid.extent();
    double spacing = std::numeric_limits<double>::infinity();
    for (const RasterGrid& other : all)
        if (isCoarser(other, grid) && other.overlap(extent) > 0.0) spacing = std::min(spacing, other.resolutionDeg());
    if (!std::isfinite(spacing)) return 0.0;
    const double middle = 0.5 * (extent.south + extent.north);
    const double side = std::min(extent.north - extent.south, (extent.east - extent.west) * cosine(middle));
    return metresPerDegree * std::min(spacing, kLargestPart * side);
}

}  // namespace

BlendBand::BlendBand(const RasterGrid& grid, const std::vector<RasterGrid>& all, const std::optional<double>& width,
                     double radius)
    : _metresPerDegree(glm::radians(radius)), _grid(grid) {
    _width = width ? *width : defaultWidth(grid, all, _metresPerDegree);
    if (!(_width > 0.0)) return;
    const RectDeg extent = grid.extent();
    RectDeg around = extent.grownBy(2.0 * grid.coarsestDeg());
    if (grid.isGlobal()) around = {extent.west, around.south, extent.east, around.north};
    std::copy_if(all.begin(), all.end(), std::back_inserter(_others),
                 [&](const RasterGrid& other) { return other.overlap(around) > other.overlap(extent); });
}

bool BlendBand::continues(const PositionDeg& beyond, const PositionDeg& position) const noexcept {
    return std::any_of(_others.begin(), _others.end(), [&](const RasterGrid& other) {
        return other.locate(beyond) && (!isCoarser(other, _grid) || !other.locate(position));
    });
}

double BlendBand::share(const PositionDeg& position) const noexcept {
    if (!(_width > 0.0)) return 1.0;
    const double pixel = _grid.resolutionDeg();
    const RectDeg extent = _grid.extent().turnedTo({position.longitudeDeg, 0.0, position.longitudeDeg, 0.0});
    const auto [latitude, longitude] = position;
    double nearest = _width;
    const auto look = [&](double degrees, const PositionDeg& beyond) {
        const double metres = std::max(0.0, degrees) * _metresPerDegree;
        if (metres < nearest && std::abs(beyond.latitudeDeg) < 90.0 && !continues(beyond, position)) nearest = metres;
    };
    look(latitude - extent.south, {extent.south - pixel, longitude});
    look(extent.north - latitude, {extent.north + pixel, longitude});
    if (!_grid.isGlobal()) {
        look((longitude - extent.west) * cosine(latitude), {latitude, extent.west - pixel});
        look((extent.east - longitude) * cosine(latitude), {latitude, extent.east + pixel});
    }
    return glm::smoothstep(0.0, 1.0, nearest / _width);
}

bool BlendBand::touches(const RectDeg& rect) const noexcept {
    if (!(_width > 0.0)) return false;
    const double degrees = _width / _metresPerDegree;
    const RectDeg extent = _grid.extent().turnedTo(rect);
    const double eastward = degrees / std::max(1e-9, std::min(cosine(rect.south), cosine(rect.north)));
    const bool isInside = rect.south >= extent.south + degrees && rect.north <= extent.north - degrees &&
                          rect.west >= extent.west + eastward && rect.east <= extent.east - eastward;
    return !isInside;
}

void BlendBand::describe(std::ostream& out) const {
    out << _width;
    for (const RasterGrid& other : _others) {
        const RectDeg extent = other.extent();
        out << ", " << extent.west << ' ' << extent.south << ' ' << extent.east << ' ' << extent.north;
    }
}

RasterLayer::RasterLayer(RasterFile file, std::optional<int> tileCells) : _file(std::move(file)) {
    if (!_file.isPlain) {
        const double posts = tileCells ? std::ldexp(TileLayout::kStartTileDeg / *tileCells,
                                                    -TileLayout::levelFor(spacingDeg(), *tileCells))
                                       : 0.0;
        _warped = warped(
            _file, tileCells ? Frame(_file.extent, posts, posts) : Frame(_file.extent, _file.eastDeg, _file.northDeg));
    }
    GeoTransform transform{};
    dataset().GetGeoTransform(transform.data());
    _grid = RasterGrid(transform, dataset().GetRasterXSize(), dataset().GetRasterYSize());
}

RasterLayer::Layers RasterLayer::elevationOf(const Settings& settings, const TileLayout* layout) {
    const bool hasOverviews = layout && settings.useOverviews;
    const double spacingDeg = hasOverviews ? layout->spacingDeg(layout->deepestLevel()) : 0.0;
    const auto tileCells = layout ? std::optional(layout->cells()) : std::nullopt;
    Layers layers;
    for (const DemInput& dem : settings.dems)
        layers.push_back(std::make_unique<RasterLayer>(RasterFile(settings, dem, true, spacingDeg), tileCells));
    std::stable_sort(layers.begin(), layers.end(),
                     [](const auto& a, const auto& b) { return a->spacingDeg() < b->spacingDeg(); });
    std::vector<RasterGrid> all;
    for (const auto& layer : layers) all.push_back(layer->grid());
    for (const auto& layer : layers)
        layer->_band = BlendBand(layer->grid(), all, settings.blend, settings.ellipsoid.equatorialRadius());
    return layers;
}

}  // namespace osgbindem

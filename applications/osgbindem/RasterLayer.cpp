// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterLayer.h"

#include "Angles.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::kRadiansPerDegree;

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
    if (!(frame.columns >= 1.0 && frame.rows >= 1.0 && frame.columns < kMost && frame.rows < kMost)) {
        throw Failure("\"" + file.input.path + "\" is too wide for its spacing; give a part of it, see gdal_translate");
    }
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
    return std::cos(latitudeDeg * kRadiansPerDegree);
}

/// The distance between two intervals, 0 when they meet.
double gap(double aLow, double aHigh, double bLow, double bHigh) {
    return std::max({0.0, bLow - aHigh, aLow - bHigh});
}

using Intervals = std::vector<std::pair<double, double>>;

/// The parts of intervals that are outside of another one.
Intervals without(const Intervals& intervals, const std::pair<double, double>& other) {
    Intervals left;
    for (const auto& [from, to] : intervals) {
        if (other.first > from) left.emplace_back(from, std::min(other.first, to));
        if (other.second < to) left.emplace_back(std::max(other.second, from), to);
    }
    return left;
}

/// Metres; 0 when no coarser raster lies below.
double defaultWidth(const RasterGrid& grid, const std::vector<RasterGrid>& all, double metresPerDegree) {
    constexpr double kLargestPart = 1.0 / 8.0;
    const RectDeg extent = grid.extent();
    double spacing = std::numeric_limits<double>::infinity();
    for (const RasterGrid& other : all) {
        if (other.resolutionDeg() > kEquallyFine * grid.resolutionDeg() && other.overlap(extent) > 0.0)
            spacing = std::min(spacing, other.resolutionDeg());
    }
    if (!std::isfinite(spacing)) return 0.0;
    const double middle = 0.5 * (extent.south + extent.north);
    const double side = std::min(extent.north - extent.south, (extent.east - extent.west) * cosine(middle));
    return metresPerDegree * std::min(spacing, kLargestPart * side);
}

}  // namespace

BlendBand::BlendBand(const RasterGrid& grid, const std::vector<RasterGrid>& all, const std::optional<double>& width,
                     double radius)
    : _metresPerDegree(radius * kRadiansPerDegree) {
    _width = width ? *width : defaultWidth(grid, all, _metresPerDegree);
    if (!(_width > 0.0)) return;
    addEdges(grid, all, true);
    if (!grid.isGlobal()) addEdges(grid, all, false);
}

void BlendBand::addEdges(const RasterGrid& grid, const std::vector<RasterGrid>& all, bool areParallels) {
    constexpr double kLeast = 1e-4;  // what is left of an edge by rounding is no border
    const auto along = [&](const RectDeg& r) {
        return areParallels ? std::pair(r.west, r.east) : std::pair(r.south, r.north);
    };
    const auto across = [&](const RectDeg& r) {
        return areParallels ? std::pair(r.south, r.north) : std::pair(r.west, r.east);
    };
    const double pixel = grid.resolutionDeg();
    const auto [first, last] = across(grid.extent());
    for (const auto& [border, outward] : {std::pair(first, -1.0), {last, 1.0}}) {
        if (areParallels && border * outward >= 90.0 - pixel) continue;
        Intervals open{along(grid.extent())};
        // Where another raster continues beyond the border, it is not open.
        for (const RasterGrid& other : all) {
            const bool isCoarser = other.resolutionDeg() > kEquallyFine * pixel;
            const double overlap = 2.0 * std::max(pixel, other.resolutionDeg());
            for (const double turn : {-360.0, 0.0, 360.0}) {
                // One round the globe has no end in the west and east.
                const double more = other.isGlobal() ? 720.0 : 0.0;
                RectDeg rect = other.extent();
                rect.west += turn - more;
                rect.east += turn + more;
                const auto [low, high] = across(rect);
                const double beyond = outward < 0.0 ? border - low : high - border;
                const double near = outward < 0.0 ? high - border : border - low;
                if (beyond > 0.5 * pixel && near > -pixel && (!isCoarser || near < overlap))
                    open = without(open, along(rect));
            }
        }
        for (const auto& [from, to] : open) {
            if (to - from < kLeast) continue;
            _edges.push_back(areParallels ? RectDeg{from, border, to, border} : RectDeg{border, from, border, to});
        }
    }
}

double BlendBand::metresTo(const RectDeg& rect) const noexcept {
    const double eastward = std::min(cosine(rect.south), cosine(rect.north));
    double nearest = std::numeric_limits<double>::infinity();
    for (const RectDeg& edge : _edges) {
        const RectDeg turned = edge.turnedTo(rect);
        const double y = gap(rect.south, rect.north, turned.south, turned.north);
        const double x = eastward * gap(rect.west, rect.east, turned.west, turned.east);
        nearest = std::min(nearest, x * x + y * y);
    }
    return _metresPerDegree * std::sqrt(nearest);
}

double BlendBand::share(const PositionDeg& position) const noexcept {
    if (_edges.empty()) return 1.0;
    const auto [latitude, longitude] = position;
    return glm::smoothstep(0.0, 1.0, metresTo({longitude, latitude, longitude, latitude}) / _width);
}

void BlendBand::describe(std::ostream& out) const {
    out << _width;
    for (const RectDeg& edge : _edges) {
        out << ", " << edge.west << ' ' << edge.south << ' ' << edge.east << ' ' << edge.north;
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

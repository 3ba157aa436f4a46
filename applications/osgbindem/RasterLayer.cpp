// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterLayer.h"

#include "Angles.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ostream>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::kRadiansPerDegree;

namespace {

/// Whether the pixels of both are those of one grid, which they meet on.
bool haveOneGrid(const RasterFile& a, const RasterFile& b) {
    if (!a.isNorthUp() || !b.isNorthUp() || a.isPlain != b.isPlain) return false;
    if (a.vertical != b.vertical || (!a.isPlain && a.horizontal.IsSame(&b.horizontal) == 0)) return false;
    GDALDataset& first = *a.dataset;
    GDALDataset& second = *b.dataset;
    if (first.GetRasterCount() != second.GetRasterCount() ||
        first.GetRasterBand(1)->GetMaskFlags() != second.GetRasterBand(1)->GetMaskFlags())
        return false;
    const GeoTransform& t = a.transform;
    const GeoTransform& u = b.transform;
    constexpr double kMost = 0.01;  // pixels
    const auto fits = [&](double size, double other, double start, double otherStart, int pixels, int otherPixels) {
        if (std::abs(size - other) * std::max(pixels, otherPixels) > kMost * std::abs(size)) return false;
        const double apart = (otherStart - start) / size;
        return std::abs(apart - std::round(apart)) <= kMost && apart <= pixels + 1.0 && apart + otherPixels >= -1.0;
    };
    return fits(t[1], u[1], t[0], u[0], first.GetRasterXSize(), second.GetRasterXSize()) &&
           fits(t[5], u[5], t[3], u[3], first.GetRasterYSize(), second.GetRasterYSize());
}

bool isElevation(GDALDataset& dataset) {
    return dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Float64;
}

RectDeg hullOf(const RectDeg& a, RectDeg b) {
    b = b.turnedTo(a);
    const RectDeg hull{std::min(a.west, b.west), std::min(a.south, b.south), std::max(a.east, b.east),
                       std::max(a.north, b.north)};
    return hull.east - hull.west < 360.0 ? hull : RectDeg{-180.0, hull.south, 180.0, hull.north};
}

/// Columns and rows of posts in degrees that rasters are warped to.
struct Frame {
    /// Holds the area and one post more, none beyond the poles. Its lattice has a post at longitude -180 and latitude
    /// 90, so that it does not depend on what is read.
    Frame(const RectDeg& area, double dx, double dy) {
        const double west = -180.0 - 0.5 * dx;
        const double north = 90.0 + 0.5 * dy;
        const bool isRound = area.east - area.west >= 360.0 - dx;
        const double column = std::floor((area.west - west) / dx) - (isRound ? 0.0 : 1.0);
        constexpr double kRounding = 1e-6;
        const double row = std::max(std::floor((north - area.north) / dy) - 1.0, 0.0);
        columns = isRound ? std::round(360.0 / dx) : std::ceil((area.east - west) / dx) + 1.0 - column;
        rows = std::min(std::ceil((north - area.south) / dy) + 1.0, std::floor(180.0 / dy + 1.0 + kRounding)) - row;
        transform = {west + column * dx, dx, 0.0, north - row * dy, 0.0, -dy};
    }
    [[nodiscard]] RasterGrid grid() const { return {transform, static_cast<int>(columns), static_cast<int>(rows)}; }

    GeoTransform transform{};
    double columns;
    double rows;
};

GdalDataset mosaicOf(const RasterLayer::Members& members) {
    std::vector<GDALDatasetH> handles;
    for (const auto& member : members) handles.push_back(GDALDataset::ToHandle(member.file.dataset.get()));
    std::reverse(handles.begin(), handles.end());  // those named later are below
    const RasterFile& first = members.front().file;
    CPLStringList words(
        CSLTokenizeString(CPLSPrintf("-resolution user -tr %.17g %.17g %s", first.transform[1], -first.transform[5],
                                     isElevation(*first.dataset) ? "-srcnodata nan -vrtnodata nan" : "")));
    return madeBy<GDALBuildVRTOptionsNew, GDALBuildVRTOptionsFree>(
        words, "make a mosaic of \"" + first.input.path + "\" and others", [&](auto* options, int* usageError) {
            const int count = static_cast<int>(handles.size());
            return GDALBuildVRT("", count, handles.data(), nullptr, options, usageError);
        });
}

GdalDataset warped(GDALDataset& dataset, const RasterFile& file, const Frame& frame) {
    constexpr double kMost = std::numeric_limits<int>::max();
    if (!(frame.columns >= 1.0 && frame.rows >= 1.0 && frame.columns < kMost && frame.rows < kMost)) {
        throw Failure("\"" + file.input.path + "\" is too wide for its spacing; give a part of it, see gdal_translate");
    }
    // Each post is transformed by itself: what is between others would depend on how the raster is divided. Its height
    // is that of its place (XSCALE, YSCALE), not the mean around it where the map's pixels are smaller.
    const GeoTransform& t = frame.transform;
    CPLStringList words(CSLTokenizeString(CPLSPrintf(
        "-of VRT -r bilinear -et 0 -novshift -wo SAMPLE_GRID=YES -te %.17g %.17g %.17g %.17g -ts %.17g %.17g %s", t[0],
        t[3] + frame.rows * t[5], t[0] + frame.columns * t[1], t[3], frame.columns, frame.rows,
        isElevation(dataset) ? "-srcnodata nan -dstnodata nan -wo XSCALE=1 -wo YSCALE=1" : "-dstalpha")));
    words.AddString("-t_srs");
    words.AddString(wktOf(file.target).c_str());
    return madeBy<GDALWarpAppOptionsNew, GDALWarpAppOptionsFree>(
        words, "bring \"" + file.input.path + "\" to latitude and longitude", [&](auto* options, int* usageError) {
            GDALDatasetH source = GDALDataset::ToHandle(&dataset);
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

RasterLayer::RasterLayer(Members members, std::optional<int> tileCells) : _members(std::move(members)) {
    _spacingDeg = std::numeric_limits<double>::infinity();
    for (const Member& member : _members)
        _spacingDeg = std::min({_spacingDeg, member.file.eastDeg, member.file.northDeg});
    if (_members.size() > 1) _mosaic = mosaicOf(_members);
    if (first().isPlain) {
        for (Member& member : _members) {
            GDALDataset& own = *member.file.dataset;
            member.grid = RasterGrid(member.file.transform, own.GetRasterXSize(), own.GetRasterYSize());
        }
    } else {
        warp(tileCells);
    }
    GeoTransform transform{};
    dataset().GetGeoTransform(transform.data());
    _grid = RasterGrid(transform, dataset().GetRasterXSize(), dataset().GetRasterYSize());
}

void RasterLayer::warp(std::optional<int> tileCells) {
    double dx = std::numeric_limits<double>::infinity();
    double dy = std::numeric_limits<double>::infinity();
    RectDeg area = first().extent;
    for (const Member& member : _members) {
        dx = std::min(dx, member.file.eastDeg);
        dy = std::min(dy, member.file.northDeg);
        area = hullOf(area, member.file.extent);
    }
    if (tileCells) {
        dx = std::ldexp(TileLayout::kStartTileDeg / *tileCells, -TileLayout::levelFor(_spacingDeg, *tileCells));
        dy = dx;
    }
    _warped = warped(_mosaic ? *_mosaic : *first().dataset, first(), Frame(area, dx, dy));
    for (Member& member : _members) member.grid = Frame(member.file.extent, dx, dy).grid();
}

GDALDataset& RasterLayer::dataset() const noexcept {
    return _warped ? *_warped : _mosaic ? *_mosaic : *first().dataset;
}

RasterLayer::Layers RasterLayer::layersOf(const Settings& settings, const std::vector<DemInput>& rasters,
                                          bool areElevation, double spacingDeg, std::optional<int> tileCells) {
    std::vector<Members> groups;
    for (std::size_t number = 0; number < rasters.size(); ++number) {
        Members own;
        own.push_back({number, RasterFile(settings, rasters[number], areElevation, spacingDeg), {}, {}});
        const RasterFile& file = own.front().file;
        // All groups that the raster joins become one with it.
        const auto apart = std::stable_partition(groups.begin(), groups.end(), [&](const Members& group) {
            return std::none_of(group.begin(), group.end(), [&](const auto& m) { return haveOneGrid(m.file, file); });
        });
        for (auto group = apart; group != groups.end(); ++group)
            std::move(group->begin(), group->end(), std::back_inserter(own));
        groups.erase(apart, groups.end());
        std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
        groups.push_back(std::move(own));
    }
    Layers layers;
    for (Members& group : groups) layers.push_back(std::make_unique<RasterLayer>(std::move(group), tileCells));
    std::sort(layers.begin(), layers.end(), [](const auto& a, const auto& b) {
        return std::pair(a->spacingDeg(), a->members().front().number) <
               std::pair(b->spacingDeg(), b->members().front().number);
    });
    std::vector<RasterGrid> all;
    for (const auto& layer : layers)
        for (const Member& member : layer->_members) all.push_back(member.grid);
    for (const auto& layer : layers)
        for (Member& member : layer->_members)
            member.band = BlendBand(member.grid, all, settings.blend, settings.ellipsoid.equatorialRadius());
    return layers;
}

RasterLayer::Layers RasterLayer::elevationOf(const Settings& settings, const TileLayout* layout) {
    if (!layout) return layersOf(settings, settings.dems, true, 0.0, std::nullopt);
    const double spacingDeg = settings.useOverviews ? layout->spacingDeg(layout->deepestLevel()) : 0.0;
    return layersOf(settings, settings.dems, true, spacingDeg, layout->cells());
}

RasterLayer::Layers RasterLayer::imagesOf(const Settings& settings) {
    std::vector<DemInput> images;
    for (const std::string& path : settings.images) images.push_back({path});
    return layersOf(settings, images, false, 0.0, std::nullopt);
}

double RasterLayer::overlap(const RectDeg& rect) const noexcept {
    double sum = 0.0;
    for (const Member& member : _members) sum += member.grid.overlap(rect);
    return sum;
}

double RasterLayer::share(const PositionDeg& position) const noexcept {
    double share = 1.0;
    for (const Member& member : _members) share = std::min(share, member.band.share(position));
    return share;
}

bool RasterLayer::isBlendedIn(const RectDeg& rect) const noexcept {
    return std::any_of(_members.begin(), _members.end(), [&](const Member& m) { return m.band.touches(rect); });
}

}  // namespace osgbindem

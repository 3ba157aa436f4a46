// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterLayer.h"

#include "Failure.h"

#include <cpl_string.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

// Spacings that differ by less are the same for rasters in different reference systems.
constexpr double kSameSpacing = 1.05;

using Numbers = std::vector<std::size_t>;

/// Numbers below `count` in groups, by their first members in order. `fit(a, b, groupOfA, groupOfB)`: whether two that
/// are in different groups make these one, of the lower of both names.
template <typename Fit>
std::vector<Numbers> grouped(std::size_t count, const Fit& fit) {
    Numbers groups(count);
    std::iota(groups.begin(), groups.end(), 0);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            const std::pair<std::size_t, std::size_t> ends = std::minmax(groups[a], groups[b]);
            if (ends.first == ends.second || !fit(a, b, groups[a], groups[b])) continue;
            std::replace(groups.begin(), groups.end(), ends.second, ends.first);
        }
    }
    std::vector<Numbers> found(count);
    for (std::size_t i = 0; i < count; ++i) found[groups[i]].push_back(i);
    found.erase(std::remove_if(found.begin(), found.end(), [](const auto& group) { return group.empty(); }),
                found.end());
    return found;
}

/// Whether intervals have no gap wider than this.
bool meet(double aLow, double aHigh, double bLow, double bHigh, double gap) {
    return aLow <= bHigh + gap && bLow <= aHigh + gap;
}

bool meetOnGlobe(const RectDeg& a, const RectDeg& b, double gap) {
    if (!meet(a.south, a.north, b.south, b.north, gap)) return false;
    const double turns = std::round((0.5 * (a.west + a.east) - 0.5 * (b.west + b.east)) / 360.0);
    for (const double turn : {turns - 1.0, turns, turns + 1.0}) {
        if (meet(a.west, a.east, b.west + 360.0 * turn, b.east + 360.0 * turn, gap)) return true;
    }
    return false;
}

bool areAlike(double a, double b, double most) {
    return a <= most * b && b <= most * a;
}

/// Whether the pixels of both are those of one grid, which they meet on.
bool haveOneGrid(const RasterFile& a, const RasterFile& b) {
    if (!a.isNorthUp() || !b.isNorthUp() || a.isPlain() != b.isPlain()) return false;
    if (a.vertical() != b.vertical() || (!a.isPlain() && a.horizontal() != b.horizontal())) return false;
    GDALDataset& first = a.dataset();
    GDALDataset& second = b.dataset();
    if (first.GetRasterCount() != second.GetRasterCount() ||
        first.GetRasterBand(1)->GetMaskFlags() != second.GetRasterBand(1)->GetMaskFlags())
        return false;
    const GeoTransform& t = a.transform();
    const GeoTransform& u = b.transform();
    constexpr double kMost = 0.01;  // pixels
    const auto fits = [&](double size, double other, double start, double otherStart, int pixels, int otherPixels) {
        if (std::abs(size - other) * std::max(pixels, otherPixels) > kMost * std::abs(size)) return false;
        const double apart = (otherStart - start) / size;
        if (std::abs(apart - std::round(apart)) > kMost) return false;
        return meet(0.0, pixels, apart, apart + otherPixels, 1.0);
    };
    return fits(t[1], u[1], t[0], u[0], first.GetRasterXSize(), second.GetRasterXSize()) &&
           fits(t[5], u[5], t[3], u[3], first.GetRasterYSize(), second.GetRasterYSize());
}

bool isElevation(GDALDataset& dataset) {
    return dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Float64;
}

void addNumbers(CPLStringList& words, const char* name, std::initializer_list<double> numbers) {
    words.AddString(name);
    for (const double number : numbers) words.AddString(CPLSPrintf("%.17g", number));
}

GdalDataset mosaicOf(std::vector<GDALDataset*> datasets, double dx, double dy, const std::string& path) {
    std::reverse(datasets.begin(), datasets.end());  // those named later are below
    CPLStringList words(CSLTokenizeString("-resolution user"));
    addNumbers(words, "-tr", {dx, dy});
    if (isElevation(*datasets.front())) {
        for (const char* word : {"-srcnodata", "nan", "-vrtnodata", "nan"}) words.AddString(word);
    }
    std::vector<GDALDatasetH> handles;
    for (GDALDataset* dataset : datasets) handles.push_back(GDALDataset::ToHandle(dataset));
    GDALBuildVRTOptions* options = GDALBuildVRTOptionsNew(words.List(), nullptr);
    int usageError = 0;
    GdalDataset mosaic(GDALDataset::FromHandle(
        GDALBuildVRT("", static_cast<int>(handles.size()), handles.data(), nullptr, options, &usageError)));
    GDALBuildVRTOptionsFree(options);
    if (!mosaic) throw Failure("cannot make a mosaic of \"" + path + "\" and others: " + gdalMessage());
    return mosaic;
}

}  // namespace

/// Columns and rows of posts in degrees that pieces are brought to.
class RasterLayer::Lattice {
public:
    /// Its first post is at longitude -180 and latitude 90, so that it does not depend on what is read.
    Lattice(double dx, double dy) : _dx(dx), _dy(dy), _west(-180.0 - 0.5 * dx), _north(90.0 + 0.5 * dy) {}
    explicit Lattice(const GeoTransform& t) : _dx(t[1]), _dy(-t[5]), _west(t[0]), _north(t[3]) {}

    [[nodiscard]] double dx() const { return _dx; }
    [[nodiscard]] double dy() const { return _dy; }

    /// The columns and rows that hold the area and one post more, none beyond the poles.
    [[nodiscard]] RectDeg around(const RectDeg& area) const {
        constexpr double kBorder = 1.0;
        RectDeg rect;
        rect.west = line(_west, _dx, std::floor((area.west - _west) / _dx) - kBorder);
        rect.east = line(_west, _dx, std::ceil((area.east - _west) / _dx) + kBorder);
        if (area.east - area.west >= 360.0 - _dx) {
            rect.west = line(_west, _dx, std::floor((area.west - _west) / _dx));
            rect.east = rect.west + _dx * std::round(360.0 / _dx);
        }
        constexpr double kRounding = 1e-6;
        const double first = std::max(std::floor((_north - area.north) / _dy) - kBorder,
                                      std::ceil((_north - 90.0) / _dy - 0.5 - kRounding));
        const double last = std::min(std::ceil((_north - area.south) / _dy) + kBorder,
                                     std::floor((_north + 90.0) / _dy + 0.5 + kRounding));
        rect.north = line(_north, -_dy, first);
        rect.south = line(_north, -_dy, last);
        return rect;
    }

private:
    static double line(double start, double step, double number) { return start + step * number; }

    double _dx;
    double _dy;
    double _west;
    double _north;
};

/// Makes layers of the rasters that are named.
class RasterLayer::Builder {
public:
    Builder(const Settings& settings, const std::vector<RasterOptions>& rasters, std::optional<int> tileCells)
        : _settings(settings), _tileCells(tileCells) {
        for (const RasterOptions& raster : rasters) _files.push_back(std::make_unique<RasterFile>(raster));
    }

    [[nodiscard]] Layers layers() {
        const std::vector<Numbers> pieces =
            grouped(_files.size(), [&](std::size_t a, std::size_t b, std::size_t, std::size_t) {
                return haveOneGrid(*_files[a], *_files[b]);
            });
        std::vector<bool> hasPlain(pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) hasPlain[i] = _files[pieces[i].front()]->isPlain();
        const auto fit = [&](std::size_t a, std::size_t b, std::size_t first, std::size_t second) {
            // Posts of a raster in degrees of the globe stay where they are.
            if ((hasPlain[first] && hasPlain[second]) || !canJoin(pieces[a], pieces[b])) return false;
            hasPlain[std::min(first, second)] = hasPlain[first] || hasPlain[second];
            return true;
        };
        Layers result;
        for (const Numbers& layer : grouped(pieces.size(), fit)) {
            std::vector<Numbers> parts;
            for (const std::size_t i : layer) parts.push_back(pieces[i]);
            result.push_back(layerOf(parts));
        }
        std::stable_sort(result.begin(), result.end(),
                         [](const auto& a, const auto& b) { return a->spacingDeg() < b->spacingDeg(); });
        blend(result);
        return result;
    }

private:
    void blend(Layers& layers) const {
        std::vector<RasterGrid> all;
        for (const auto& layer : layers)
            for (const Member& member : layer->_members) all.push_back(member.grid);
        for (const auto& layer : layers) {
            for (Member& member : layer->_members) {
                member.band = BlendBand(member.grid, all, _settings.blend, _settings.ellipsoid.equatorialRadius());
                if (!member.band.isEmpty()) layer->_bands.push_back(&member.band);
            }
        }
    }

    [[nodiscard]] bool canJoin(const Numbers& a, const Numbers& b) const {
        const RasterFile& first = *_files[a.front()];
        const RasterFile& second = *_files[b.front()];
        if ((first.isPlain() && !first.isNorthUp()) || (second.isPlain() && !second.isNorthUp())) return false;
        if (first.vertical() != second.vertical() || !areAlike(first.northDeg(), second.northDeg(), kSameSpacing))
            return false;
        const double gap = 2.0 * std::max({first.eastDeg(), second.eastDeg(), first.northDeg(), second.northDeg()});
        return std::any_of(a.begin(), a.end(), [&](std::size_t i) {
            return std::any_of(b.begin(), b.end(), [&](std::size_t j) {
                return meetOnGlobe(_files[i]->extent(), _files[j]->extent(), gap);
            });
        });
    }

    [[nodiscard]] std::unique_ptr<RasterLayer> layerOf(const std::vector<Numbers>& parts) {
        std::unique_ptr<RasterLayer> layer(new RasterLayer);
        layer->_spacingDeg = std::numeric_limits<double>::infinity();
        for (const Numbers& part : parts) {
            for (const std::size_t i : part) {
                layer->_spacingDeg = std::min({layer->_spacingDeg, _files[i]->eastDeg(), _files[i]->northDeg()});
            }
        }
        const Lattice lattice = latticeOf(parts, layer->_spacingDeg);
        for (const Numbers& part : parts) {
            Piece piece;
            for (const std::size_t number : part) {
                piece.members.push_back(layer->_members.size());
                layer->_members.push_back(
                    {number, std::move(_files[number]), RasterGrid({0, 1, 0, 0, 0, -1}, 1, 1), {}, {}});
            }
            piece.dataset = mosaic(*layer, piece);
            layer->_pieces.push_back(std::move(piece));
        }
        const RasterFile& first = *layer->_members.front().file;
        if (parts.size() == 1 && first.isPlain()) {
            layer->_dataset = layer->_pieces.front().dataset;
        } else {
            merge(*layer, lattice);
        }
        GeoTransform transform{};
        layer->_dataset->GetGeoTransform(transform.data());
        layer->_grid = RasterGrid(transform, layer->width(), layer->height());
        for (Member& member : layer->_members) placeMember(member, lattice, layer->_grid);
        return layer;
    }

    [[nodiscard]] Lattice latticeOf(const std::vector<Numbers>& parts, double spacingDeg) const {
        double dx = std::numeric_limits<double>::infinity();
        double dy = std::numeric_limits<double>::infinity();
        for (const Numbers& part : parts) {
            for (const std::size_t i : part) {
                if (_files[i]->isPlain()) return Lattice(_files[i]->transform());
                dx = std::min(dx, _files[i]->eastDeg());
                dy = std::min(dy, _files[i]->northDeg());
            }
        }
        if (!_tileCells) return {dx, dy};
        const double posts =
            std::ldexp(TileLayout::kStartTileDeg / *_tileCells, -TileLayout::levelFor(spacingDeg, *_tileCells));
        return {posts, posts};
    }

    /// All members of a piece, in their own reference system.
    [[nodiscard]] static GDALDataset* mosaic(RasterLayer& layer, const Piece& piece) {
        if (piece.members.size() == 1) return &layer._members[piece.members.front()].file->dataset();
        const RasterFile& first = *layer._members[piece.members.front()].file;
        std::vector<GDALDataset*> datasets;
        for (const std::size_t i : piece.members) datasets.push_back(&layer._members[i].file->dataset());
        return &layer._made.keep(
            mosaicOf(std::move(datasets), first.transform()[1], -first.transform()[5], first.path()));
    }

    /// Brings all pieces to the lattice and makes one mosaic of them.
    static void merge(RasterLayer& layer, const Lattice& lattice) {
        std::vector<GDALDataset*> datasets;
        std::optional<RectDeg> whole;
        for (const Piece& piece : layer._pieces) {
            if (layer._members[piece.members.front()].file->isPlain()) whole = areaOf(*piece.dataset);
        }
        for (Piece& piece : layer._pieces) {
            const RasterFile& first = *layer._members[piece.members.front()].file;
            if (first.isPlain()) {
                datasets.push_back(piece.dataset);
                continue;
            }
            RectDeg area = first.extent();
            for (const std::size_t i : piece.members) area = hullOf(area, layer._members[i].file->extent());
            if (whole) area = turnedTo(area, *whole);
            area = lattice.around(area);
            piece.transform = std::make_unique<PixelTransform>(*piece.dataset, first.target(), first.path());
            datasets.push_back(&layer._made.keep(warped(*piece.dataset, first, area, lattice)));
            whole = whole ? unionOf(*whole, area) : area;
        }
        layer._dataset =
            datasets.size() == 1
                ? datasets.front()
                : &layer._made.keep(mosaicOf(std::move(datasets), lattice.dx(), lattice.dy(), layer.path()));
    }

    /// In the raster's own coordinates.
    [[nodiscard]] static RectDeg areaOf(GDALDataset& dataset) {
        GeoTransform t{};
        dataset.GetGeoTransform(t.data());
        return {t[0], t[3] + dataset.GetRasterYSize() * t[5], t[0] + dataset.GetRasterXSize() * t[1], t[3]};
    }
    [[nodiscard]] static RectDeg unionOf(const RectDeg& a, const RectDeg& b) {
        return {std::min(a.west, b.west), std::min(a.south, b.south), std::max(a.east, b.east),
                std::max(a.north, b.north)};
    }
    /// The area, moved by whole turns so that it lies next to the other one.
    [[nodiscard]] static RectDeg turnedTo(RectDeg area, const RectDeg& other) {
        const double turn =
            360.0 * std::round((0.5 * (other.west + other.east) - 0.5 * (area.west + area.east)) / 360.0);
        area.west += turn;
        area.east += turn;
        return area;
    }
    [[nodiscard]] static RectDeg hullOf(const RectDeg& a, const RectDeg& b) {
        const RectDeg hull = unionOf(a, turnedTo(b, a));
        return hull.east - hull.west < 360.0 ? hull : RectDeg{-180.0, hull.south, 180.0, hull.north};
    }

    [[nodiscard]] static GdalDataset warped(GDALDataset& dataset, const RasterFile& file, const RectDeg& area,
                                            const Lattice& lattice) {
        const double columns = std::round((area.east - area.west) / lattice.dx());
        const double rows = std::round((area.north - area.south) / lattice.dy());
        if (!(columns >= 1.0 && rows >= 1.0 && columns < std::numeric_limits<int>::max() &&
              rows < std::numeric_limits<int>::max())) {
            throw Failure("\"" + file.path() + "\" is too wide for its spacing; give a part of it, see gdal_translate");
        }
        // Each post is transformed by itself: what is between others would depend on how the raster is divided.
        CPLStringList words(CSLTokenizeString("-of VRT -r bilinear -et 0 -novshift -wo SAMPLE_GRID=YES"));
        words.AddString("-t_srs");
        words.AddString(wktOf(file.target()).c_str());
        addNumbers(words, "-te", {area.west, area.south, area.east, area.north});
        addNumbers(words, "-ts", {columns, rows});
        if (isElevation(dataset)) {
            for (const char* word : {"-srcnodata", "nan", "-dstnodata", "nan"}) words.AddString(word);
        } else {
            words.AddString("-dstalpha");
        }
        GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words.List(), nullptr);
        GDALDatasetH source = GDALDataset::ToHandle(&dataset);
        int usageError = 0;
        GdalDataset result(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, &usageError)));
        GDALWarpAppOptionsFree(options);
        if (!result) {
            throw Failure("cannot bring \"" + file.path() + "\" to latitude and longitude: " + gdalMessage());
        }
        return result;
    }

    static void placeMember(Member& member, const Lattice& lattice, const RasterGrid& grid) {
        const RasterFile& file = *member.file;
        RectDeg area = file.extent();
        if (file.isPlain()) {
            member.grid =
                RasterGrid(file.transform(), file.dataset().GetRasterXSize(), file.dataset().GetRasterYSize());
        } else {
            area = lattice.around(area);
            member.grid = RasterGrid({area.west, lattice.dx(), 0.0, area.north, 0.0, -lattice.dy()},
                                     static_cast<int>(std::round((area.east - area.west) / lattice.dx())),
                                     static_cast<int>(std::round((area.north - area.south) / lattice.dy())));
        }
        area = turnedTo(member.grid.extent(), grid.extent());
        const auto [first, last] = std::minmax({grid.rowOf(area.north), grid.rowOf(area.south)});
        const double east = grid.columnOf(area.east);
        const double west = grid.columnOf(area.west);
        member.window = {static_cast<int>(std::lround(west + 0.5)), static_cast<int>(std::lround(first + 0.5)),
                         static_cast<int>(std::lround(east - west)), static_cast<int>(std::lround(last - first))};
    }

    const Settings& _settings;
    std::vector<std::unique_ptr<RasterFile>> _files;
    std::optional<int> _tileCells;
};

RasterLayer::Layers RasterLayer::elevationOf(const Settings& settings, const TileLayout* layout) {
    std::vector<RasterOptions> rasters;
    for (const DemInput& dem : settings.dems) {
        const bool hasSpacing = settings.useOverviews && layout;
        rasters.push_back({dem.path, settings.nodata, settings.isWgs84, true,
                           hasSpacing ? layout->spacingDeg(layout->deepestLevel()) : 0.0, dem.metresPerUnit,
                           settings.band});
    }
    return Builder(settings, rasters, layout ? std::optional(layout->cells()) : std::nullopt).layers();
}

RasterLayer::Layers RasterLayer::imagesOf(const Settings& settings) {
    std::vector<RasterOptions> rasters;
    for (const std::string& path : settings.images) rasters.push_back({path, {}, settings.isWgs84, false, 0.0, {}, {}});
    return Builder(settings, rasters, std::nullopt).layers();
}

double RasterLayer::share(const PositionDeg& position) const noexcept {
    double share = 1.0;
    for (const BlendBand* band : _bands) share = std::min(share, band->share(position));
    return share;
}

bool RasterLayer::isBlendedIn(const RectDeg& rect) const noexcept {
    return std::any_of(_bands.begin(), _bands.end(), [&](const BlendBand* band) { return band->touches(rect); });
}

void RasterLayer::forSources(const PixelWindow& window, const VisitSource& visit) const {
    for (const Piece& piece : _pieces) {
        if (!piece.transform) continue;
        for (const PixelWindow& source : sourceWindows(piece, window)) visit(*piece.dataset, source);
    }
}

std::vector<PixelWindow> RasterLayer::sourceWindows(const Piece& piece, const PixelWindow& window) const {
    // Small blocks keep the rectangles around turned footprints tight.
    constexpr int kSide = 64;
    constexpr int kSteps = 5;
    constexpr double kPadding = 2.0;  // pixels: the kernel's reach, and the bend between the probed points
    const double width = piece.dataset->GetRasterXSize();
    const double height = piece.dataset->GetRasterYSize();
    std::vector<PixelWindow> result;
    for (int row = window.row; row < window.row + window.height; row += kSide) {
        for (int column = window.column; column < window.column + window.width; column += kSide) {
            const int columns = std::min(kSide, window.column + window.width - column);
            const int rows = std::min(kSide, window.row + window.height - row);
            PixelTransform::Places places;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const PositionDeg corner = _grid.position(column, row);
                const PositionDeg end = _grid.position(column + columns, row + rows);
                const double u = static_cast<double>(i % kSteps) / (kSteps - 1);
                const double v = static_cast<double>(i / kSteps) / (kSteps - 1);
                const double latitude = corner.latitudeDeg + v * (end.latitudeDeg - corner.latitudeDeg);
                places.add(corner.longitudeDeg + u * (end.longitudeDeg - corner.longitudeDeg),
                           std::clamp(latitude, -90.0, 90.0));
            }
            piece.transform->toPixels(places);
            double west = HUGE_VAL, north = HUGE_VAL, east = -HUGE_VAL, south = -HUGE_VAL;
            for (std::size_t i = 0; i < places.x.size(); ++i) {
                if (places.isFound[i] == 0) continue;
                west = std::min(west, places.x[i]);
                east = std::max(east, places.x[i]);
                north = std::min(north, places.y[i]);
                south = std::max(south, places.y[i]);
            }
            const int firstColumn = static_cast<int>(std::clamp(std::floor(west - kPadding), 0.0, width));
            const int firstRow = static_cast<int>(std::clamp(std::floor(north - kPadding), 0.0, height));
            const int endColumn = static_cast<int>(std::clamp(std::ceil(east + kPadding), 0.0, width));
            const int endRow = static_cast<int>(std::clamp(std::ceil(south + kPadding), 0.0, height));
            if (firstColumn >= endColumn || firstRow >= endRow) continue;
            result.push_back({firstColumn, firstRow, endColumn - firstColumn, endRow - firstRow});
        }
    }
    return result;
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GdalRaster.h"

#include "Failure.h"
#include "Interruption.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

using GeoTransform = std::array<double, 6>;

// An overview's posts are not exactly twice as far apart when the raster has an odd number of them.
constexpr double kSlack = 1e-3;

// Drivers of text that find a row by reading those above it. GDAL tries rows that cannot be read anew for each row
// below: 2^rows times in a file that was cut short, unless it is read from the top.
bool isRowsOfText(GDALDataset& dataset) {
    const std::array<std::string_view, 3> drivers{"AAIGrid", "GRASSASCIIGrid", "ISG"};
    const GDALDriver* driver = dataset.GetDriver();
    return driver != nullptr && std::find(drivers.begin(), drivers.end(), driver->GetDescription()) != drivers.end();
}

void requireAllRows(GDALDataset& dataset, const std::string& path) {
    for (int row = 0; row < dataset.GetRasterYSize(); ++row) {
        throwIfStopRequested();
        double post = 0.0;
        const CPLErr error =
            dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, row, 1, 1, &post, 1, 1, GDT_Float64, 0, 0, nullptr);
        if (error != CE_None) throw Failure("cannot read \"" + path + "\": " + gdalMessage());
    }
}

/// `overview`: its number, or -1 for the raster itself.
GdalDataset open(const std::string& path, int overview = -1) {
    CPLStringList words;
    if (overview >= 0) words.SetNameValue("OVERVIEW_LEVEL", std::to_string(overview).c_str());
    GdalDataset dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, nullptr, words.List(), nullptr));
    if (!dataset) {
        // GDAL has names that are no files, so the file system is asked only afterwards.
        const std::string reason =
            mayExist(path) ? gdalMessage() + "; give a raster file" : "no such file; check the name";
        throw Failure("cannot open \"" + path + "\": " + reason);
    }
    if (dataset->GetRasterCount() == 0) {
        throw Failure("no raster band in \"" + path + "\"; name one of its subdatasets as gdalinfo lists them");
    }
    if (isRowsOfText(*dataset)) requireAllRows(*dataset, path);
    return dataset;
}

// Without a reference system, degrees are recognised by their range.
bool looksLikeDegrees(const GeoTransform& t, int width, int height) {
    const double east = t[0] + width * t[1];
    const double other = t[3] + height * t[5];
    return t[1] > 0.0 && t[0] >= -361.0 && east <= 721.0 && east - t[0] <= 361.0 &&
           std::abs(t[3]) <= 90.0 + std::abs(t[5]) && std::abs(other) <= 90.0 + std::abs(t[5]);
}

bool isPlain(const GeoTransform& t) {
    return t[2] == 0.0 && t[4] == 0.0 && t[1] > 0.0 && t[5] != 0.0;
}

// Whether all corners are at numbers that coordinates may be; GDAL brings degrees into range turn by turn.
bool isPlausible(const GeoTransform& t, GDALDataset& dataset) {
    constexpr double kMostDegrees = 1e4;
    constexpr double kMostUnits = 1e11;  // of a length, be it millimetres
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    const double most = reference != nullptr && reference->IsGeographic() ? kMostDegrees : kMostUnits;
    for (const double column : {0.0, static_cast<double>(dataset.GetRasterXSize())}) {
        for (const double row : {0.0, static_cast<double>(dataset.GetRasterYSize())}) {
            const double x = t[0] + column * t[1] + row * t[2];
            const double y = t[3] + column * t[4] + row * t[5];
            if (!(std::abs(x) <= most && std::abs(y) <= most)) return false;
        }
    }
    return true;
}

bool needsWarp(GDALDataset& dataset, const std::string& path) {
    GeoTransform transform{};
    const bool hasTransform = dataset.GetGeoTransform(transform.data()) == CE_None;
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    const bool hasControlPoints = dataset.GetGCPCount() > 0 && dataset.GetGCPSpatialRef() != nullptr;
    if (!hasTransform && !hasControlPoints) {
        throw Failure("no georeferencing in \"" + path + "\"; add it, for example with gdal_edit.py -a_srs -a_ullr");
    }
    if (!hasTransform) return true;
    if (!isPlausible(transform, dataset)) {
        throw Failure("the coordinates of \"" + path + "\" are far from any globe; correct its georeferencing");
    }
    if (reference != nullptr && !reference->IsGeographic()) return true;
    if (!isPlain(transform) && reference != nullptr) return true;
    if (reference == nullptr &&
        (!isPlain(transform) || !looksLikeDegrees(transform, dataset.GetRasterXSize(), dataset.GetRasterYSize()))) {
        throw Failure("no reference system in \"" + path +
                      "\", and its coordinates are not degrees; add one, for example with gdal_edit.py -a_srs");
    }
    return false;
}

std::string targetReference(GDALDataset& source, bool isWgs84) {
    if (isWgs84) return "EPSG:4326";
    const OGRSpatialReference* reference = source.GetSpatialRef();
    if (reference == nullptr) reference = source.GetGCPSpatialRef();
    const std::unique_ptr<OGRSpatialReference> geographic(reference->CloneGeogCS());
    return wktOf(*geographic);
}

RasterGrid gridOf(GDALDataset& dataset, const std::string& path) {
    GeoTransform transform{};
    dataset.GetGeoTransform(transform.data());
    constexpr double kFinestDeg = 1e-9;  // a tenth of a millimetre
    if (!(std::abs(transform[1]) >= kFinestDeg && std::abs(transform[5]) >= kFinestDeg)) {
        throw Failure("the pixels of \"" + path + "\" have no size on a globe; correct its georeferencing");
    }
    const RasterGrid grid(transform, dataset.GetRasterXSize(), dataset.GetRasterYSize());
    const RectDeg extent = grid.extent();
    if (!(extent.south < 90.0 && extent.north > -90.0)) {
        throw Failure("no part of \"" + path + "\" lies between latitudes -90 and 90; correct its georeferencing");
    }
    return grid;
}

}  // namespace

std::string gdalMessage() {
    std::string text = CPLGetLastErrorMsg();
    if (text.empty()) text = "not a raster that GDAL reads";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string wktOf(const OGRSpatialReference& reference) {
    char* text = nullptr;
    reference.exportToWkt(&text);
    std::string result(text);
    CPLFree(text);
    return result;
}

bool mayExist(const std::string& path) {
    std::error_code ignored;
    return path.rfind("/vsi", 0) == 0 || std::filesystem::exists(path, ignored);
}

void GdalRaster::TransformerFree::operator()(void* transformer) const {
    GDALDestroyGenImgProjTransformer(transformer);
}

GdalRaster::GdalRaster(const RasterOptions& options)
    : _path(options.path), _source(open(options.path)), _grid({0.0, 1.0, 0.0, 0.0, 0.0, -1.0}, 1, 1) {
    if (!options.isElevation) expandPalette();
    toLatitudeLongitude(options);
    if (options.spacingDeg > 0.0) takeOverview(options);
}

void GdalRaster::toLatitudeLongitude(const RasterOptions& options) {
    if (needsWarp(*_source, _path)) warp(options);
    _grid = gridOf(dataset(), _path);
}

void GdalRaster::takeOverview(const RasterOptions& options) {
    GDALRasterBand& band = *_source->GetRasterBand(1);
    const double fullDeg = _grid.resolutionDeg();
    int level = -1;
    double coarsestDeg = fullDeg;
    for (int i = 0; i < band.GetOverviewCount(); ++i) {
        GDALRasterBand* overview = band.GetOverview(i);
        if (overview == nullptr) continue;
        const double deg = fullDeg * std::max(static_cast<double>(band.GetXSize()) / overview->GetXSize(),
                                              static_cast<double>(band.GetYSize()) / overview->GetYSize());
        if (deg <= coarsestDeg || deg > options.spacingDeg * (1.0 + kSlack)) continue;
        coarsestDeg = deg;
        level = i;
    }
    if (level < 0) return;
    _toSource.reset();
    _warped.reset();
    _source = open(_path, level);
    toLatitudeLongitude(options);
}

void GdalRaster::expandPalette() {
    if (_source->GetRasterBand(1)->GetColorTable() == nullptr) return;
    CPLStringList words(CSLTokenizeString("-of VRT -expand rgba"));
    GDALTranslateOptions* options = GDALTranslateOptionsNew(words.List(), nullptr);
    int usageError = 0;
    GDALDatasetH expanded = GDALTranslate("", GDALDataset::ToHandle(_source.get()), options, &usageError);
    GDALTranslateOptionsFree(options);
    if (expanded == nullptr) throw Failure("cannot read the colours of \"" + _path + "\": " + gdalMessage());
    _file = std::move(_source);
    _source.reset(GDALDataset::FromHandle(expanded));
}

void GdalRaster::warp(const RasterOptions& options) {
    const std::string target = targetReference(*_source, options.isWgs84);
    CPLStringList words(CSLTokenizeString("-of VRT -r bilinear -t_srs"));
    words.AddString(target.c_str());
    for (const char* word : {"-ot", "Float64", "-dstnodata", "nan"}) {
        if (options.isElevation) words.AddString(word);
    }
    if (options.isElevation && options.nodata) {
        words.AddString("-srcnodata");
        words.AddString(CPLSPrintf("%.17g", *options.nodata));
    }
    if (!options.isElevation) words.AddString("-dstalpha");
    GDALWarpAppOptions* warpOptions = GDALWarpAppOptionsNew(words.List(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(_source.get());
    int usageError = 0;
    GDALDatasetH warped = GDALWarp("", nullptr, 1, &source, warpOptions, &usageError);
    GDALWarpAppOptionsFree(warpOptions);
    _warped.reset(GDALDataset::FromHandle(warped));
    if (_warped) _toSource.reset(GDALCreateGenImgProjTransformer2(source, warped, nullptr));
    if (!_warped || !_toSource) {
        throw Failure("cannot bring \"" + _path + "\" to latitude and longitude: " + gdalMessage());
    }
}

std::vector<PixelWindow> GdalRaster::sourceWindows(const PixelWindow& window) const {
    // Small blocks keep the rectangles around turned footprints tight.
    constexpr int kSide = 64;
    std::vector<PixelWindow> result;
    for (int row = window.row; row < window.row + window.height; row += kSide) {
        for (int column = window.column; column < window.column + window.width; column += kSide) {
            const auto source = sourceWindow({column, row, std::min(kSide, window.column + window.width - column),
                                              std::min(kSide, window.row + window.height - row)});
            if (source) result.push_back(*source);
        }
    }
    return result;
}

std::optional<PixelWindow> GdalRaster::sourceWindow(const PixelWindow& window) const {
    constexpr int kSteps = 5;
    constexpr double kPadding = 2.0;  // pixels: the kernel's reach, and the bend between the probed points
    std::array<double, kSteps * kSteps> x{};
    std::array<double, kSteps * kSteps> y{};
    std::array<double, kSteps * kSteps> z{};
    std::array<int, kSteps * kSteps> success{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = window.column + window.width * static_cast<double>(i % kSteps) / (kSteps - 1);
        y[i] = window.row + window.height * static_cast<double>(i / kSteps) / (kSteps - 1);
    }
    GDALGenImgProjTransform(_toSource.get(), TRUE, static_cast<int>(x.size()), x.data(), y.data(), z.data(),
                            success.data());
    double west = HUGE_VAL, north = HUGE_VAL, east = -HUGE_VAL, south = -HUGE_VAL;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (success[i] == 0) continue;
        west = std::min(west, x[i]);
        east = std::max(east, x[i]);
        north = std::min(north, y[i]);
        south = std::max(south, y[i]);
    }
    const double width = _source->GetRasterXSize();
    const double height = _source->GetRasterYSize();
    const int firstColumn = static_cast<int>(std::clamp(std::floor(west - kPadding), 0.0, width));
    const int firstRow = static_cast<int>(std::clamp(std::floor(north - kPadding), 0.0, height));
    const int endColumn = static_cast<int>(std::clamp(std::ceil(east + kPadding), 0.0, width));
    const int endRow = static_cast<int>(std::clamp(std::ceil(south + kPadding), 0.0, height));
    if (firstColumn >= endColumn || firstRow >= endRow) return std::nullopt;
    return PixelWindow{firstColumn, firstRow, endColumn - firstColumn, endRow - firstRow};
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// osgbindem's command line, an argument per line up to a line that is empty, and then a small raster of any type, place
// and shape, which is read as the arguments say: refused with one line, or settings in range and finite heights.

#include "Fuzz.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <DemMosaic.h>
#include <Failure.h>
#include <Settings.h>
#include <cmath>
#include <optional>
#include <vector>

namespace {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::test::Bytes;
using osgAnalyticBin::test::require;
using osgAnalyticBin::test::requireOneLine;

constexpr const char* kFile = "/vsimem/fuzz.tif";

/// Takes the lines up to an empty one.
std::vector<std::string> takeArguments(Bytes& bytes) {
    std::vector<std::string> arguments{"osgbindem"};
    while (!bytes.empty()) {
        std::string line;
        for (char c = static_cast<char>(bytes.byte()); c != '\n' && c != '\0'; c = static_cast<char>(bytes.byte()))
            line += c;
        if (line.empty()) break;
        arguments.push_back(line);
    }
    return arguments;
}

std::optional<osgbindem::Settings> settingsOf(const std::vector<std::string>& arguments) {
    std::vector<const char*> words;
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    try {
        return osgbindem::settingsFrom(static_cast<int>(words.size()), words.data());
    } catch (const Failure& failure) {
        requireOneLine(failure);
        return std::nullopt;
    }
}

void requireRanges(const osgbindem::Settings& settings) {
    require(!settings.dems.empty() && !settings.output.empty());
    for (const osgbindem::DemInput& dem : settings.dems)
        require(!dem.metresPerUnit || (std::isfinite(*dem.metresPerUnit) && *dem.metresPerUnit != 0.0));
    require(!settings.threads || *settings.threads >= 1);
    require(settings.lodFactor >= 3.0 && settings.lodFactor <= 100.0);
    require(!settings.cells || (*settings.cells >= 4 && *settings.cells <= 240));
    require(!settings.levels || (*settings.levels >= 0 && *settings.levels <= 20));
    const double a = settings.ellipsoid.equatorialRadius();
    require(a >= 1e4 && a <= 1e9);
}

void georeference(GDALDataset& dataset, Bytes& bytes) {
    const double dx = 360.0 / dataset.GetRasterXSize();
    const double dy = 180.0 / dataset.GetRasterYSize();
    std::array<double, 6> transform{
        bytes.between(-200.0, 200.0), bytes.between(0.0, dx), 0.0, bytes.between(-95.0, 95.0), 0.0,
        bytes.between(-dy, dy)};
    const int kind = bytes.below(5);
    if (kind == 0) transform = {-180.0, dx, 0.0, 90.0, 0.0, -dy};
    if (kind == 1) transform = {4e5, bytes.between(1.0, 1e5), 0.0, 5e6, 0.0, -bytes.between(1.0, 1e5)};
    if (kind == 2) transform[2] = bytes.number(), transform[4] = bytes.number();
    for (std::size_t i = 0; kind == 3 && i < 6; ++i) transform[i] = bytes.number();
    if (bytes.byte() != 255) dataset.SetGeoTransform(transform.data());

    constexpr std::array<int, 6> kReferences{0, 4326, 4267, 32633, 3857, 3031};
    const int code = bytes.pick(kReferences);
    OGRSpatialReference reference;
    if (code != 0 && reference.importFromEPSG(code) == OGRERR_NONE) dataset.SetSpatialRef(&reference);
}

void setNodata(GDALRasterBand& band, Bytes& bytes) {
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 5, 0)
    // a double is refused there
    constexpr std::array<std::int64_t, 4> kOdd{0, -1, std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max()};
    if (band.GetRasterDataType() == GDT_Int64) return (void)band.SetNoDataValueAsInt64(bytes.pick(kOdd));
    if (band.GetRasterDataType() == GDT_UInt64)
        return (void)band.SetNoDataValueAsUInt64(static_cast<std::uint64_t>(bytes.pick(kOdd)));
#endif
    band.SetNoDataValue(bytes.number());
}

/// Returns: whether there is a raster.
bool writeRaster(Bytes& bytes) {
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const auto type = static_cast<GDALDataType>(1 + bytes.below(GDT_TypeCount - 1));  // all that GDAL knows
    const int width = 1 + bytes.below(16);
    const int height = 1 + bytes.below(16);
    GDALDataset* const dataset = driver->Create(kFile, width, height, 1, type, nullptr);
    if (!dataset) return false;
    georeference(*dataset, bytes);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    const int marks = bytes.byte();
    if (marks & 1) setNodata(band, bytes);
    if (marks & 2) band.SetScale(bytes.number());
    if (marks & 4) band.SetOffset(bytes.number());
    const int pixelSize = GDALGetDataTypeSizeBytes(type);
    std::vector<GByte> pixels(static_cast<std::size_t>(width * height * pixelSize));
    for (GByte& part : pixels) part = bytes.byte();
    const CPLErr error =
        band.RasterIO(GF_Write, 0, 0, width, height, pixels.data(), width, height, type, 0, 0, nullptr);
    GDALClose(dataset);
    return error == CE_None;
}

void readRaster(const osgbindem::Settings& settings) {
    osgbindem::DemMosaic mosaic(settings);
    require(mosaic.finestDeg() > 0.0 && mosaic.finestGlobalDeg() > 0.0);
    (void)mosaic.inspect();
    for (const double latitude : {-90.0, -45.5, 0.0, 12.25, 67.5}) {
        for (const double longitude : {-180.0, -90.5, 0.0, 33.5, 157.5}) {
            require(std::isfinite(mosaic.height({latitude, longitude})));
            const osgbindem::RectDeg rect{longitude, latitude, longitude + 22.5, latitude + 22.5};
            require(mosaic.posts(rect) >= 0.0);
            (void)mosaic.hasFinerData(rect, 0.1);
            require(std::isfinite(mosaic.height({latitude + 5.1, longitude + 7.3})));
            const osgAnalyticBin::core::Interval range = mosaic.range(rect);
            require(std::isfinite(range.width()) && range.width() >= 0.0);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMostBytes = 8192;
    if (size > kMostBytes) return 0;
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    Bytes bytes(data, size);
    std::optional<osgbindem::Settings> settings = settingsOf(takeArguments(bytes));
    if (!settings) return 0;
    requireRanges(*settings);
    // no file of the user's is opened
    for (osgbindem::DemInput& dem : settings->dems) dem.path = kFile;
    constexpr std::size_t kMostRasters = 3;
    if (settings->dems.size() > kMostRasters) settings->dems.resize(kMostRasters);
    try {
        if (writeRaster(bytes)) readRaster(*settings);
    } catch (const Failure& failure) {
        requireOneLine(failure);
    }
    VSIUnlink(kFile);
    return 0;
}

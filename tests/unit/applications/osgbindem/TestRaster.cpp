// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TestRaster.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <stdexcept>

OpenRaster::OpenRaster(const std::string& path, unsigned int access) {
    GDALAllRegister();
    _dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | access);
    if (!_dataset) throw std::runtime_error("cannot open " + path);
}

OpenRaster::OpenRaster(const std::string& path, const Shape& shape, GDALDataType type, double west, double north,
                       double dx, double dy, const std::string& reference, const char* option) {
    GDALAllRegister();
    char* options[] = {const_cast<char*>(option), nullptr};
    _dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), shape.width, shape.height,
                                                                        shape.bands, type, options);
    if (!_dataset) throw std::runtime_error("cannot write " + path);
    double transform[6] = {west, dx, 0.0, north, 0.0, -dy};
    _dataset->SetGeoTransform(transform);
    OGRSpatialReference system;
    system.SetFromUserInput(reference.c_str());
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (!reference.empty()) _dataset->SetSpatialRef(&system);
}

OpenRaster::~OpenRaster() {
    GDALClose(GDALDataset::ToHandle(_dataset));
}

std::vector<double> OpenRaster::read(GDALRasterBand& band) {
    const int width = band.GetXSize(), height = band.GetYSize();
    std::vector<double> numbers(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    if (band.RasterIO(GF_Read, 0, 0, width, height, numbers.data(), width, height, GDT_Float64, 0, 0, nullptr) !=
        CE_None)
        throw std::runtime_error("cannot read a raster");
    return numbers;
}

void OpenRaster::write(GDALRasterBand& band, std::vector<double> numbers) {
    const int width = band.GetXSize(), height = band.GetYSize();
    if (band.RasterIO(GF_Write, 0, 0, width, height, numbers.data(), width, height, GDT_Float64, 0, 0, nullptr) !=
        CE_None)
        throw std::runtime_error("cannot write a raster");
}

TestRaster::TestRaster(double firstLongitude, double firstLatitude, double dx, double dy, int width, int height,
                       const Height& heightAt)
    : _firstLongitude(firstLongitude), _firstLatitude(firstLatitude), _dx(dx), _dy(dy), _width(width), _height(height) {
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            _heights.push_back(heightAt(firstLatitude - row * dy, firstLongitude + column * dx));
}

TestRaster TestRaster::globe(double spacingDeg, const Height& heightAt) {
    const int rows = static_cast<int>(std::lround(180.0 / spacingDeg)) + 1;
    return {-180.0, 90.0, spacingDeg, spacingDeg, 2 * (rows - 1), rows, heightAt};
}

TestRaster::TestRaster(const std::string& path) {
    const OpenRaster file(path);
    double t[6];
    file->GetGeoTransform(t);
    _width = file->GetRasterXSize();
    _height = file->GetRasterYSize();
    _dx = t[1];
    if (std::abs(_width * _dx - 360.0) < 0.5 * _dx) _dx = 360.0 / _width;
    _dy = -t[5];
    _firstLongitude = t[0] + 0.5 * t[1];
    _firstLatitude = t[3] - 0.5 * _dy;
    _heights = OpenRaster::read(file.band());
    int hasNodata = 0;
    const double nodata = file.band().GetNoDataValue(&hasNodata);
    if (hasNodata != 0) std::replace(_heights.begin(), _heights.end(), nodata, std::nan(""));
}

TestRaster& TestRaster::withNodata(double nodata) {
    _nodata = nodata;
    return *this;
}

TestRaster& TestRaster::in(const std::string& reference) {
    _reference = reference;
    return *this;
}

std::string TestRaster::write(const std::string& path) const {
    const OpenRaster file(path, {_width, _height, 1}, GDT_Float64, _firstLongitude - 0.5 * _dx,
                          _firstLatitude + 0.5 * _dy, _dx, _dy, _reference);
    std::vector<double> heights = _heights;
    if (_nodata) {
        file.band().SetNoDataValue(*_nodata);
        std::replace_if(
            heights.begin(), heights.end(), [](double h) { return std::isnan(h); }, *_nodata);
    }
    OpenRaster::write(file.band(), heights);
    return path;
}

Range TestRaster::range(const Rect& rect) const {
    constexpr double kSlack = 1.0 + 1e-6;
    std::vector<int> columns;
    for (int column = 0; column < _width; ++column) {
        for (int turn = -2; turn <= 2; ++turn) {
            const double x = _firstLongitude + column * _dx + 360.0 * turn;
            if (x <= rect.west - _dx * kSlack || x >= rect.east + _dx * kSlack) continue;
            columns.push_back(column);
            break;
        }
    }
    Range range;
    for (int row = 0; row < _height; ++row) {
        const double y = _firstLatitude - row * _dy;
        if (y < rect.south - _dy * kSlack || y > rect.north + _dy * kSlack) continue;
        for (const int column : columns)
            if (!std::isnan(at(column, row))) range.include(at(column, row));
    }
    return range;
}

double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kDegree;
    const double l = longitudeDeg * kDegree;
    return 400.0 + 1500.0 * std::sin(7.0 * p + 1.0) * std::cos(11.0 * l) +
           600.0 * std::sin(61.0 * p) * std::sin(83.0 * l + 0.5);
}

TestRaster::Height flat(double metres) {
    return [metres](double, double) { return metres; };
}

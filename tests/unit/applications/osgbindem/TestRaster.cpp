// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TestRaster.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <stdexcept>

TestRaster::TestRaster(double firstLongitude, double firstLatitude, double dx, double dy, int width, int height,
                       const Height& heightAt)
    : _firstLongitude(firstLongitude), _firstLatitude(firstLatitude), _dx(dx), _dy(dy), _width(width), _height(height) {
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            _heights.push_back(heightAt(firstLatitude - row * dy, firstLongitude + column * dx));
        }
    }
}

TestRaster TestRaster::globe(double spacingDeg, const Height& heightAt) {
    const int rows = static_cast<int>(std::lround(180.0 / spacingDeg)) + 1;
    return {-180.0, 90.0, spacingDeg, spacingDeg, 2 * (rows - 1), rows, heightAt};
}

TestRaster::TestRaster(const std::string& path) {
    GDALAllRegister();
    GDALDataset* dataset = GDALDataset::FromHandle(GDALOpen(path.c_str(), GA_ReadOnly));
    if (dataset == nullptr) throw std::runtime_error("cannot open " + path);
    double t[6];
    dataset->GetGeoTransform(t);
    _width = dataset->GetRasterXSize();
    _height = dataset->GetRasterYSize();
    _dx = t[1];
    if (std::abs(_width * _dx - 360.0) < 0.5 * _dx) _dx = 360.0 / _width;
    _dy = -t[5];
    _firstLongitude = t[0] + 0.5 * t[1];
    _firstLatitude = t[3] - 0.5 * _dy;
    _heights.resize(static_cast<std::size_t>(_width) * static_cast<std::size_t>(_height));
    GDALRasterBand* band = dataset->GetRasterBand(1);
    const CPLErr error =
        band->RasterIO(GF_Read, 0, 0, _width, _height, _heights.data(), _width, _height, GDT_Float64, 0, 0, nullptr);
    int hasNodata = 0;
    const double nodata = band->GetNoDataValue(&hasNodata);
    if (hasNodata != 0) std::replace(_heights.begin(), _heights.end(), nodata, std::nan(""));
    GDALClose(GDALDataset::ToHandle(dataset));
    if (error != CE_None) throw std::runtime_error("cannot read " + path);
}

void TestRaster::write(const std::string& path) const {
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDataset* dataset = driver->Create(path.c_str(), _width, _height, 1, GDT_Float64, nullptr);
    double t[6] = {_firstLongitude - 0.5 * _dx, _dx, 0.0, _firstLatitude + 0.5 * _dy, 0.0, -_dy};
    dataset->SetGeoTransform(t);
    OGRSpatialReference reference;
    reference.SetFromUserInput(_reference.c_str());
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (!_reference.empty()) dataset->SetSpatialRef(&reference);
    std::vector<double> heights = _heights;
    GDALRasterBand* band = dataset->GetRasterBand(1);
    if (_nodata) {
        band->SetNoDataValue(*_nodata);
        std::replace_if(
            heights.begin(), heights.end(), [](double h) { return std::isnan(h); }, *_nodata);
    }
    const CPLErr error =
        band->RasterIO(GF_Write, 0, 0, _width, _height, heights.data(), _width, _height, GDT_Float64, 0, 0, nullptr);
    GDALClose(GDALDataset::ToHandle(dataset));
    if (error != CE_None) throw std::runtime_error("cannot write " + path);
}

Range TestRaster::range(const Rect& rect) const {
    constexpr double kSlack = 1e-6;
    std::vector<int> columns;
    for (int column = 0; column < _width; ++column) {
        const double longitude = _firstLongitude + column * _dx;
        for (int turn = -2; turn <= 2; ++turn) {
            const double x = longitude + 360.0 * turn;
            if (x > rect.west - _dx * (1.0 + kSlack) && x < rect.east + _dx * (1.0 + kSlack)) {
                columns.push_back(column);
                break;
            }
        }
    }
    Range range;
    for (int row = 0; row < _height; ++row) {
        const double y = _firstLatitude - row * _dy;
        if (y < rect.south - _dy * (1.0 + kSlack) || y > rect.north + _dy * (1.0 + kSlack)) continue;
        for (const int column : columns) {
            if (!std::isnan(at(column, row))) range.include(at(column, row));
        }
    }
    return range;
}

double TestRaster::height(double latitudeDeg, double longitudeDeg) const {
    const double y = (_firstLatitude - latitudeDeg) / _dy;
    double x = std::fmod((longitudeDeg - _firstLongitude) / _dx, 360.0 / _dx);
    if (x < -1e-6) x += 360.0 / _dx;
    x = std::fmax(x, 0.0);
    const bool isGlobal = std::abs(_width * _dx - 360.0) < 1e-6;
    const int column = static_cast<int>(x + 1e-9);
    const int row = std::min(static_cast<int>(y + 1e-9), _height - 1);
    if (row < 0 || column >= _width) return std::nan("");
    const int east = isGlobal ? (column + 1) % _width : std::min(column + 1, _width - 1);
    const int south = std::min(row + 1, _height - 1);
    const double u = std::fmax(x - column, 0.0);
    const double v = std::fmax(y - row, 0.0);
    return (1 - v) * ((1 - u) * at(column, row) + u * at(east, row)) +
           v * ((1 - u) * at(column, south) + u * at(east, south));
}

double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kDegree;
    const double l = longitudeDeg * kDegree;
    return 400.0 + 1500.0 * std::sin(7.0 * p + 1.0) * std::cos(11.0 * l) +
           600.0 * std::sin(61.0 * p) * std::sin(83.0 * l + 0.5);
}

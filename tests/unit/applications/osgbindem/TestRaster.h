// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// A rectangle in degrees.
struct Rect {
    double west, south, east, north;
};

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    void include(double value) {
        lower = std::fmin(lower, value);
        upper = std::fmax(upper, value);
    }
};

/// A raster file that is open with GDAL until this is destroyed.
class OpenRaster {
public:
    struct Shape {
        int width, height, bands;
    };

    explicit OpenRaster(const std::string& path, unsigned int access = GDAL_OF_READONLY) {
        GDALAllRegister();
        _dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | access);
        if (!_dataset) throw std::runtime_error("cannot open " + path);
    }

    /// Makes a GeoTIFF. `west`, `north`: of its corner. `option`: for GDAL, as NAME=VALUE.
    OpenRaster(const std::string& path, const Shape& shape, GDALDataType type, double west, double north, double dx,
               double dy, const std::string& reference = "EPSG:4326", const char* option = nullptr) {
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
    OpenRaster(const OpenRaster&) = delete;
    OpenRaster& operator=(const OpenRaster&) = delete;
    ~OpenRaster() { GDALClose(GDALDataset::ToHandle(_dataset)); }

    GDALDataset* operator->() const { return _dataset; }
    [[nodiscard]] GDALRasterBand& band(int number = 1) const { return *_dataset->GetRasterBand(number); }

    [[nodiscard]] static std::vector<double> read(GDALRasterBand& band) {
        const int width = band.GetXSize(), height = band.GetYSize();
        std::vector<double> numbers(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        if (band.RasterIO(GF_Read, 0, 0, width, height, numbers.data(), width, height, GDT_Float64, 0, 0, nullptr) !=
            CE_None)
            throw std::runtime_error("cannot read a raster");
        return numbers;
    }
    static void write(GDALRasterBand& band, std::vector<double> numbers) {
        const int width = band.GetXSize(), height = band.GetYSize();
        if (band.RasterIO(GF_Write, 0, 0, width, height, numbers.data(), width, height, GDT_Float64, 0, 0, nullptr) !=
            CE_None)
            throw std::runtime_error("cannot write a raster");
    }

private:
    GDALDataset* _dataset;
};

/// A grid of heights kept in memory, as a file for the program and as the truth about it.
class TestRaster {
public:
    using Height = std::function<double(double latitudeDeg, double longitudeDeg)>;

    /// Posts from the first (north-west) one on; heights from the function; NaN where there are none.
    TestRaster(double firstLongitude, double firstLatitude, double dx, double dy, int width, int height,
               const Height& heightAt)
        : _firstLongitude(firstLongitude),
          _firstLatitude(firstLatitude),
          _dx(dx),
          _dy(dy),
          _width(width),
          _height(height) {
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                _heights.push_back(heightAt(firstLatitude - row * dy, firstLongitude + column * dx));
    }

    /// As many posts in both directions.
    TestRaster(double firstLongitude, double firstLatitude, double spacing, int posts, const Height& heightAt)
        : TestRaster(firstLongitude, firstLatitude, spacing, spacing, posts, posts, heightAt) {}

    /// Reads a file with GDAL.
    explicit TestRaster(const std::string& path) {
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

    /// A raster round the globe with posts on the poles.
    static TestRaster globe(double spacingDeg, const Height& heightAt) {
        const int rows = static_cast<int>(std::lround(180.0 / spacingDeg)) + 1;
        return {-180.0, 90.0, spacingDeg, spacingDeg, 2 * (rows - 1), rows, heightAt};
    }

    /// What a file has in place of missing heights; without it, NaN.
    TestRaster& withNodata(double nodata) {
        _nodata = nodata;
        return *this;
    }

    /// Sets the reference system, WGS 84 by default; an empty text: the file has none.
    TestRaster& in(const std::string& reference) {
        _reference = reference;
        return *this;
    }

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const {
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

    /// The heights of all posts not farther than one pixel from the rectangle; longitudes modulo 360.
    [[nodiscard]] Range range(const Rect& rect) const {
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

private:
    [[nodiscard]] double at(int column, int row) const {
        return _heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(_width) +
                        static_cast<std::size_t>(column)];
    }

    double _firstLongitude, _firstLatitude, _dx, _dy;
    int _width, _height;
    std::vector<double> _heights;
    std::optional<double> _nodata;
    std::string _reference = "EPSG:4326";
};

/// Hills that differ everywhere.
[[nodiscard]] inline double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kDegree;
    const double l = longitudeDeg * kDegree;
    return 400.0 + 1500.0 * std::sin(7.0 * p + 1.0) * std::cos(11.0 * l) +
           600.0 * std::sin(61.0 * p) * std::sin(83.0 * l + 0.5);
}

/// One height everywhere.
[[nodiscard]] inline TestRaster::Height flat(double metres) {
    return [metres](double, double) { return metres; };
}

/// Red, green, blue.
using Colour = std::array<int, 3>;

/// How a file marks places without a pixel.
enum class Hole { Alpha, Mask, Nodata, Palette };

/// An image, square degree by square degree: `pixels` by `pixels` from the north-west corner on.
struct TestImage {
    TestImage(double westDeg, double northDeg, double pixelDeg, int side, const Colour& colour)
        : west(westDeg), north(northDeg), spacingDeg(pixelDeg), pixels(side) {
        colourAt = [colour](double, double) { return colour; };
    }

    /// Round the globe: twice as many columns as rows.
    [[nodiscard]] static TestImage globe(double spacingDeg, const Colour& colour) {
        return {-180.0, 90.0, spacingDeg, static_cast<int>(std::lround(360.0 / spacingDeg)), colour};
    }

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const {
        constexpr int kNodata = 7;
        const int rows = std::min(pixels, static_cast<int>(std::lround((north + 90.0) / spacingDeg)));
        Bands bands;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < pixels; ++column) {
                const auto colour = colourAt(north - (row + 0.5) * spacingDeg, west + (column + 0.5) * spacingDeg);
                for (std::size_t c = 0; c < 3; ++c) bands[c].push_back(colour ? (*colour)[c] : kNodata);
                bands[3].push_back(colour ? 255 : 0);
            }
        }
        CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
        const int count = hole == Hole::Palette ? 1 : hole == Hole::Alpha ? 4 : 3;
        const OpenRaster file(path, {pixels, rows, count}, GDT_Byte, west, north, spacingDeg, spacingDeg);
        if (hole == Hole::Alpha) file.band(4).SetColorInterpretation(GCI_AlphaBand);
        if (hole == Hole::Mask) file->CreateMaskBand(GMF_PER_DATASET);
        if (hole == Hole::Palette) writePalette(file.band(), bands);
        for (int band = 1; band <= 3 && hole != Hole::Palette; ++band) {
            if (hole == Hole::Nodata) file.band(band).SetNoDataValue(kNodata);
            OpenRaster::write(file.band(band), bands[static_cast<std::size_t>(band - 1)]);
        }
        if (hole == Hole::Alpha) OpenRaster::write(file.band(4), bands[3]);
        if (hole == Hole::Mask) OpenRaster::write(*file.band().GetMaskBand(), bands[3]);
        return path;
    }

    double west, north, spacingDeg;
    int pixels;
    /// nullopt: a hole. With a palette there is one colour.
    std::function<std::optional<Colour>(double latitudeDeg, double longitudeDeg)> colourAt;
    Hole hole = Hole::Alpha;

private:
    using Bands = std::array<std::vector<double>, 4>;

    /// Index 1 is the colour, index 0 the hole.
    static void writePalette(GDALRasterBand& band, const Bands& bands) {
        std::vector<double> indices;
        GDALColorTable table;
        for (std::size_t i = 0; i < bands[3].size(); ++i) {
            indices.push_back(bands[3][i] > 0 ? 1 : 0);
            const auto part = [&](std::size_t c) { return static_cast<short>(bands[c][i]); };
            const GDALColorEntry entry{part(0), part(1), part(2), 255};
            if (indices.back() == 1) table.SetColorEntry(1, &entry);
        }
        band.SetNoDataValue(0.0);
        band.SetColorTable(&table);
        OpenRaster::write(band, indices);
    }
};

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gdal_priv.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
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

    explicit OpenRaster(const std::string& path, unsigned int access = GDAL_OF_READONLY);

    /// Makes a GeoTIFF. `west`, `north`: of its corner. `option`: for GDAL, as NAME=VALUE.
    OpenRaster(const std::string& path, const Shape& shape, GDALDataType type, double west, double north, double dx,
               double dy, const std::string& reference = "EPSG:4326", const char* option = nullptr);
    OpenRaster(const OpenRaster&) = delete;
    OpenRaster& operator=(const OpenRaster&) = delete;
    ~OpenRaster();

    GDALDataset* operator->() const { return _dataset; }
    [[nodiscard]] GDALRasterBand& band(int number = 1) const { return *_dataset->GetRasterBand(number); }

    [[nodiscard]] static std::vector<double> read(GDALRasterBand& band);
    static void write(GDALRasterBand& band, std::vector<double> numbers);

private:
    GDALDataset* _dataset;
};

/// A grid of heights kept in memory, as a file for the program and as the truth about it.
class TestRaster {
public:
    using Height = std::function<double(double latitudeDeg, double longitudeDeg)>;

    /// Posts from the first (north-west) one on; heights from the function; NaN where there are none.
    TestRaster(double firstLongitude, double firstLatitude, double dx, double dy, int width, int height,
               const Height& heightAt);

    /// As many posts in both directions.
    TestRaster(double firstLongitude, double firstLatitude, double spacing, int posts, const Height& heightAt)
        : TestRaster(firstLongitude, firstLatitude, spacing, spacing, posts, posts, heightAt) {}

    /// Reads a file with GDAL.
    explicit TestRaster(const std::string& path);

    /// A raster round the globe with posts on the poles.
    static TestRaster globe(double spacingDeg, const Height& heightAt);

    /// What a file has in place of missing heights; without it, NaN.
    TestRaster& withNodata(double nodata);
    /// Sets the reference system, WGS 84 by default; an empty text: the file has none.
    TestRaster& in(const std::string& reference);

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const;

    /// The heights of all posts not farther than one pixel from the rectangle; longitudes modulo 360.
    [[nodiscard]] Range range(const Rect& rect) const;

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
[[nodiscard]] double hills(double latitudeDeg, double longitudeDeg);

/// One height everywhere.
[[nodiscard]] TestRaster::Height flat(double metres);

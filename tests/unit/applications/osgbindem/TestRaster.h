// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

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

/// A grid of heights kept in memory, as a file for the program and as the truth about it.
class TestRaster {
public:
    using Height = std::function<double(double latitudeDeg, double longitudeDeg)>;

    /// Posts from the first (north-west) one on; heights from the function; NaN where there are none.
    TestRaster(double firstLongitude, double firstLatitude, double dx, double dy, int width, int height,
               const Height& heightAt);

    /// Reads a file with GDAL.
    explicit TestRaster(const std::string& path);

    /// A raster round the globe with posts on the poles.
    static TestRaster globe(double spacingDeg, const Height& heightAt);

    void setNodata(double nodata) { _nodata = nodata; }
    void setReference(const std::string& reference) { _reference = reference; }
    void write(const std::string& path) const;

    /// The heights of all posts not farther than one pixel from the rectangle; longitudes modulo 360.
    [[nodiscard]] Range range(const Rect& rect) const;

    /// Bilinear between posts, longitudes modulo 360; NaN outside.
    [[nodiscard]] double height(double latitudeDeg, double longitudeDeg) const;

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

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PixelTransform.h"
#include "RasterBands.h"
#include "RasterGrid.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

using GeoTransform = std::array<double, 6>;

/// What was looked at of an elevation raster: all of it, or evenly spread posts of a large one.
struct RasterLook {
    double share = 1.0;
    double posts = 0.0;
    double missing = 0.0;
    /// Numbers that the file does not declare to be missing, and that no terrain has.
    double marks = 0.0;
    double lastMark = 0.0;
};

/// A raster file opened with GDAL. Elevation is one band of metres, with NaN for all that the file marks as missing in
/// any way; colours are bands of bytes, red, green, blue or grey, and alpha where there is any.
class RasterFile final {
public:
    /// Throws Failure.
    explicit RasterFile(const RasterOptions& options);

    [[nodiscard]] const std::string& path() const noexcept { return _path; }
    [[nodiscard]] GDALDataset& dataset() const noexcept { return _decoded ? *_decoded : *_file; }
    /// As the file has it.
    [[nodiscard]] GDALDataset& file() const noexcept { return *_file; }

    /// Whether the raster's own coordinates are the degrees of the globe, rows along parallels.
    [[nodiscard]] bool isPlain() const noexcept { return _isPlain; }
    [[nodiscard]] const GeoTransform& transform() const noexcept { return _transform; }
    /// The geotransform is there, without rotation, north up.
    [[nodiscard]] bool isNorthUp() const noexcept;

    /// The area; goes round the globe for a raster that holds a pole.
    [[nodiscard]] const RectDeg& extent() const noexcept { return _extent; }
    /// The distance between posts along parallels where it is least, and along meridians in the middle.
    [[nodiscard]] double eastDeg() const noexcept { return _eastDeg; }
    [[nodiscard]] double northDeg() const noexcept { return _northDeg; }

    /// The reference system without its vertical part, and that part; empty without one.
    [[nodiscard]] const std::string& horizontal() const noexcept { return _horizontal; }
    [[nodiscard]] const std::string& vertical() const noexcept { return _vertical; }
    /// Longitude and latitude in degrees on the globe.
    [[nodiscard]] const OGRSpatialReference& target() const noexcept { return _target; }

    /// What the user should know: units that are no metres, the band of several.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return _notes; }

    /// Requires: elevation. Throws Failure.
    [[nodiscard]] RasterLook look() const;
    /// Reads all of the raster only where the look has found nothing.
    [[nodiscard]] bool hasHeights(const RasterLook& look) const;

private:
    void open(const RasterOptions& options, int overview);
    void takeReference(const RasterOptions& options);
    void place();
    void placeWarped();
    [[nodiscard]] bool isInDegreesOfGlobe() const;
    [[nodiscard]] int overviewFor(double spacingDeg) const;

    std::string _path;
    GdalDataset _file;
    /// The metres or colours that are made of the file; empty where the file itself has them.
    GdalDataset _decoded;
    bool _isPlain = false;
    bool _hasTransform = false;
    GeoTransform _transform{};
    RectDeg _extent;
    double _eastDeg = 0.0;
    double _northDeg = 0.0;
    std::string _horizontal;
    std::string _vertical;
    OGRSpatialReference _target;
    std::vector<std::string> _notes;
};

/// The radii of the ellipsoid that a raster declares, where it is not the earth's. Throws Failure.
struct Radii {
    double equatorial = 0.0;
    double polar = 0.0;
};
[[nodiscard]] std::optional<Radii> foreignRadiiOf(const std::string& path);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Failure.h"
#include "RasterBands.h"
#include "RasterGrid.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

using GeoTransform = std::array<double, 6>;

/// A raster file opened with GDAL. Elevation is one band of metres, with NaN for all that the file marks as missing in
/// any way; colours are bands of bytes, red, green, blue and alpha.
class RasterFile final {
public:
    /// `isElevation`: false for colours. `spacingDeg`: the coarsest overview whose posts are no farther apart is read
    /// in place of the raster; 0 for none. Throws Failure.
    RasterFile(const Settings& settings, DemInput input, bool isElevation, double spacingDeg);

    [[nodiscard]] const DemInput& input() const noexcept { return _input; }
    [[nodiscard]] const std::string& path() const noexcept { return _input.path; }
    [[nodiscard]] GDALDataset& dataset() const noexcept { return *_decoded; }
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
    [[nodiscard]] const OGRSpatialReference& horizontal() const noexcept { return _horizontal; }
    [[nodiscard]] const std::string& vertical() const noexcept { return _vertical; }
    /// Longitude and latitude in degrees on the globe.
    [[nodiscard]] const OGRSpatialReference& target() const noexcept { return _target; }

    /// What the user should know: units that are no metres, the band of several.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return _notes; }

    /// Looks at all of the raster, or at evenly spread posts of a large one; at all of it, too, while none has a
    /// height. Requires: elevation. Throws Failure.
    [[nodiscard]] RasterLook look() const;
    [[nodiscard]] double posts() const {
        return static_cast<double>(_file->GetRasterXSize()) * _file->GetRasterYSize();
    }

private:
    void open(const Settings& settings, bool isElevation, int overview);
    void takeReference(bool isWgs84);
    void place();
    void placeWarped();
    [[nodiscard]] bool isInDegreesOfGlobe() const;
    /// From the raster's own coordinates to degrees of the globe. Throws Failure.
    [[nodiscard]] std::unique_ptr<OGRCoordinateTransformation> wayToGlobe() const;
    [[nodiscard]] osgAnalyticBin::support::Failure noWayToGlobe() const;
    [[nodiscard]] int overview(double spacingDeg) const;

    DemInput _input;
    GdalDataset _file;
    /// The metres or colours that are made of the file.
    GdalDataset _decoded;
    bool _isPlain = false;
    bool _hasTransform = false;
    GeoTransform _transform{};
    RectDeg _extent;
    double _eastDeg = 0.0;
    double _northDeg = 0.0;
    OGRSpatialReference _horizontal;
    std::string _vertical;
    OGRSpatialReference _target;
    std::vector<std::string> _notes;
};

/// The ellipsoid that a raster declares, where it is not the earth's. Throws Failure.
[[nodiscard]] std::optional<osgAnalyticBin::core::Ellipsoid> foreignEllipsoidOf(const std::string& path);

}  // namespace osgbindem

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
struct RasterFile {
    /// `isElevation`: false for colours. `spacingDeg`: the coarsest overview whose posts are no farther apart is read
    /// in place of the raster; 0 for none. Throws Failure.
    RasterFile(const Settings& settings, DemInput input, bool isElevation, double spacingDeg);

    [[nodiscard]] bool isNorthUp() const noexcept { return isUnturned && transform[5] < 0.0; }
    [[nodiscard]] double posts() const { return static_cast<double>(file->GetRasterXSize()) * file->GetRasterYSize(); }
    /// Looks at all of the raster, or at evenly spread posts of a large one; at all of it, too, while none has a
    /// height. Requires: elevation. Throws Failure.
    [[nodiscard]] RasterLook look() const;

    DemInput input;
    /// As it is, and the metres or colours that are made of it.
    GdalDataset file;
    GdalDataset dataset;
    /// What the user should know: units that are no metres, the band of several.
    std::vector<std::string> notes;

    /// The reference system without its vertical part, and that part; empty without one.
    OGRSpatialReference horizontal;
    std::string vertical;
    /// Longitude and latitude in degrees on the globe.
    OGRSpatialReference target;

    GeoTransform transform{};
    /// The geotransform is there, without rotation.
    bool isUnturned = false;
    /// The raster's own coordinates are the degrees of the globe, rows along parallels.
    bool isPlain = false;
    /// The area; goes round the globe for a raster that holds a pole.
    RectDeg extent;
    /// The distance between posts along parallels where it is least, and along meridians in the middle.
    double eastDeg = 0.0;
    double northDeg = 0.0;

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
};

/// The ellipsoid that a raster declares, where it is not the earth's. Throws Failure.
[[nodiscard]] std::optional<osgAnalyticBin::core::Ellipsoid> foreignEllipsoidOf(const std::string& path);

}  // namespace osgbindem

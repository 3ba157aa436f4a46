// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Gdal.h"
#include "RasterGrid.h"
#include "Settings.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace osgbindem {

using GeoTransform = std::array<double, 6>;

/// The heights of a raster as one band of metres, with NaN for missing heights, so that whatever is made of it mixes no
/// mark for missing data with heights. `file`: has to last as long. `horizontal`: the reference system without its
/// vertical part. `notes`: get what the user should know. Throws Failure.
[[nodiscard]] GdalDataset heightsOf(GDALDataset& file, const Settings& settings, const DemInput& input,
                                    const OGRSpatialReference& horizontal, std::vector<std::string>& notes);

/// The colours of a raster as bands of bytes: red, green, blue and alpha. `file`: has to last as long. Throws Failure.
[[nodiscard]] GdalDataset coloursOf(GDALDataset& file, const std::string& path);

/// A raster file opened with GDAL. Elevation is one band of metres, with NaN for all that the file marks as missing in
/// any way; colours are bands of bytes, red, green, blue and alpha.
struct RasterFile {
    /// `isElevation`: false for colours. `spacingDeg`: the coarsest overview whose posts are no farther apart is read
    /// in place of the raster; 0 for none. Throws Failure.
    RasterFile(const Settings& settings, DemInput input, bool isElevation, double spacingDeg);

    /// Looks at parts of the raster, and at all of it where these have no height.
    /// Requires: elevation. Throws Failure where there is none, or it cannot be read.
    void requireHeights() const;

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
    void takeTransform();
    void takeReference(bool isWgs84);
    void place();
    void placeWarped();
    [[nodiscard]] bool isInDegreesOfGlobe() const;
    /// From the raster's own coordinates to degrees of the globe. Throws Failure.
    [[nodiscard]] std::unique_ptr<OGRCoordinateTransformation> wayToGlobe() const;
    [[nodiscard]] Failure noWayToGlobe() const;
    [[nodiscard]] int overview(double spacingDeg) const;
};

/// The settings with the radii of the first raster where that is of another body than the earth and none are given;
/// says so. Throws Failure.
[[nodiscard]] Settings withDeclaredRadii(Settings settings);

}  // namespace osgbindem

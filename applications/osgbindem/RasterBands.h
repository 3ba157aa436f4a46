// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Gdal.h"

#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

struct RasterOptions {
    std::string path;
    std::optional<double> nodata;
    /// The globe is WGS 84; else longitudes and latitudes are those of the raster's own ellipsoid.
    bool isWgs84 = true;
    /// Elevation, not colours.
    bool isElevation = true;
    /// No finer posts are needed: the raster's coarsest overview that is as fine counts as the raster; 0 for none.
    double spacingDeg = 0.0;
    /// As the user says; without it, by what the raster declares.
    std::optional<double> metresPerUnit;
    /// The band with heights, or a single one of an image; without it, the first with heights, or all colours.
    std::optional<int> band;
};

/// What was read of a raster's heights.
struct RasterLook {
    double posts = 0.0;
    double missing = 0.0;
    /// Numbers that the file does not declare to be missing, and that no terrain has; and the last of them.
    double marks = 0.0;
    double lastMark = 0.0;
};

/// The heights of a raster as one band of metres, with NaN for missing heights, so that whatever is made of it mixes no
/// mark for missing data with heights. `file`: has to last as long. `horizontal`: the reference system without its
/// vertical part. `notes`: get what the user should know. Throws Failure.
[[nodiscard]] GdalDataset heightsOf(GDALDataset& file, const RasterOptions& options,
                                    const OGRSpatialReference& horizontal, std::vector<std::string>& notes);

/// What has been read so far of such heights, to be reset.
[[nodiscard]] RasterLook& lookOf(GDALDataset& heights);

/// The colours of a raster as bands of bytes: red, green, blue and alpha. `file`: has to last as long. Throws Failure.
[[nodiscard]] GdalDataset coloursOf(GDALDataset& file, const std::string& path);

}  // namespace osgbindem

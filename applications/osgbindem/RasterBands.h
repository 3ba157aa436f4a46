// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Gdal.h"
#include "Settings.h"

#include <string>
#include <vector>

namespace osgbindem {

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
[[nodiscard]] GdalDataset heightsOf(GDALDataset& file, const Settings& settings, const DemInput& input,
                                    const OGRSpatialReference& horizontal, std::vector<std::string>& notes);

/// What has been read so far of such heights, to be reset.
[[nodiscard]] RasterLook& lookOf(GDALDataset& heights);

/// The colours of a raster as bands of bytes: red, green, blue and alpha. `file`: has to last as long. Throws Failure.
[[nodiscard]] GdalDataset coloursOf(GDALDataset& file, const std::string& path);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <gdal_priv.h>

#include <string>

namespace osgbindem {

/// Where a raster that is warped lies on the globe.
struct WarpedPlace {
    /// For a raster that holds a pole: all longitudes.
    RectDeg extent;
    /// The distance between pixels along parallels where it is least, and along meridians in the middle.
    double eastDeg = 0.0;
    double northDeg = 0.0;
};

/// `target`: longitude and latitude in degrees. Throws Failure when no place is known.
[[nodiscard]] WarpedPlace warpedPlaceOf(GDALDataset& dataset, const OGRSpatialReference& target,
                                        const std::string& path);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <gdal_priv.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// Pixels and lines of a raster, and the longitudes and latitudes of the globe. Not for use by several threads.
class PixelTransform final {
public:
    /// `target`: longitude and latitude in degrees. Throws Failure.
    PixelTransform(GDALDataset& dataset, const OGRSpatialReference& target, const std::string& path);

    struct Places {
        std::vector<double> x;
        std::vector<double> y;
        std::vector<int> isFound;

        void add(double placeX, double placeY) {
            x.push_back(placeX);
            y.push_back(placeY);
        }
    };
    void toDegrees(Places& places) const { transform(places, false); }
    void toPixels(Places& places) const { transform(places, true); }

private:
    struct Free {
        void operator()(void* transformer) const;
    };
    void transform(Places& places, bool isInverse) const;

    std::unique_ptr<void, Free> _transformer;
};

/// Where a raster that is warped lies on the globe.
struct WarpedPlace {
    /// Goes round the globe for a raster that holds a pole.
    RectDeg extent;
    /// The distance between pixels along parallels where it is least, and along meridians in the middle.
    double eastDeg = 0.0;
    double northDeg = 0.0;
};
/// Of a raster of so many pixels. Returns: nullopt where no place is known.
[[nodiscard]] std::optional<WarpedPlace> warpedPlaceOf(const PixelTransform& transform, int width, int height);

}  // namespace osgbindem

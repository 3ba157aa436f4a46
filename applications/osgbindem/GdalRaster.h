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

/// The last message of GDAL on one line.
[[nodiscard]] std::string gdalMessage();

/// A reference system as text.
[[nodiscard]] std::string wktOf(const OGRSpatialReference& reference);

/// Whether there is a file of this name; of names that begin with /vsi only GDAL knows, so there may be one.
/// No name that the file system refuses is a file's.
[[nodiscard]] bool mayExist(const std::string& path);

struct GdalClose {
    void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};
using GdalDataset = std::unique_ptr<GDALDataset, GdalClose>;

struct RasterOptions {
    std::string path;
    std::optional<double> nodata;
    /// Rasters that are not in geographic coordinates are warped to WGS84 if this holds, else to the geographic
    /// coordinates of their own reference system.
    bool isWgs84 = true;
    /// Elevation, not colours: one band of doubles with NaN for what is missing.
    bool isElevation = true;
    /// No finer posts are needed: the raster's coarsest overview that is as fine counts as the raster; 0 for none.
    double spacingDeg = 0.0;
};

/// A raster opened with GDAL, seen in geographic coordinates: as it is, or through a warped virtual raster.
class GdalRaster final {
public:
    /// Throws Failure.
    explicit GdalRaster(const RasterOptions& options);

    [[nodiscard]] const std::string& path() const noexcept { return _path; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _grid; }
    [[nodiscard]] GDALDataset& dataset() const noexcept { return _warped ? *_warped : *_source; }
    [[nodiscard]] int width() const { return dataset().GetRasterXSize(); }
    [[nodiscard]] int height() const { return dataset().GetRasterYSize(); }

    /// The raster as the file has it; nullptr when it is not warped.
    [[nodiscard]] GDALDataset* warpSource() const noexcept { return _warped ? _source.get() : nullptr; }

    /// Windows of the raster in the file that hold every pixel that has part in a window of the warped raster.
    [[nodiscard]] std::vector<PixelWindow> sourceWindows(const PixelWindow& window) const;

private:
    struct TransformerFree {
        void operator()(void* transformer) const;
    };

    void expandPalette();
    void toLatitudeLongitude(const RasterOptions& options);
    void takeOverview(const RasterOptions& options);
    void warp(const RasterOptions& options);
    [[nodiscard]] std::optional<PixelWindow> sourceWindow(const PixelWindow& window) const;

    std::string _path;
    GdalDataset _file;  // beneath _source when that is a virtual raster of its colours
    GdalDataset _source;
    GdalDataset _warped;
    std::unique_ptr<void, TransformerFree> _toSource;
    RasterGrid _grid;
};

}  // namespace osgbindem

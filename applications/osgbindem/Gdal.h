// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <memory>
#include <string>

namespace osgbindem {

/// The last message of GDAL on one line.
[[nodiscard]] std::string gdalMessage();

/// A reference system as text.
[[nodiscard]] std::string wktOf(const OGRSpatialReference& reference);

/// The reference system of a raster's transform or else of its control points; null without one.
[[nodiscard]] const OGRSpatialReference* referenceOf(GDALDataset& dataset);

/// Whether there is a file of this name; of names that begin with /vsi only GDAL knows, so there may be one.
/// No name that the file system refuses is a file's.
[[nodiscard]] bool mayExist(const std::string& path);

struct GdalClose {
    void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};
using GdalDataset = std::unique_ptr<GDALDataset, GdalClose>;

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace osgbindem {

/// The last message of GDAL on one line.
[[nodiscard]] inline std::string gdalMessage() {
    std::string text = CPLGetLastErrorMsg();
    if (text.empty()) text = "not a raster that GDAL reads";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// A reference system as text.
[[nodiscard]] inline std::string wktOf(const OGRSpatialReference& reference) {
    char* text = nullptr;
    reference.exportToWkt(&text);
    std::string result(text);
    CPLFree(text);
    return result;
}

/// The reference system of a raster's transform or else of its control points; null without one.
[[nodiscard]] inline const OGRSpatialReference* referenceOf(GDALDataset& dataset) {
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    return reference != nullptr ? reference : dataset.GetGCPSpatialRef();
}

/// Whether there is a file of this name; of names that begin with /vsi only GDAL knows, so there may be one.
/// No name that the file system refuses is a file's.
[[nodiscard]] inline bool mayExist(const std::string& path) {
    std::error_code ignored;
    return path.rfind("/vsi", 0) == 0 || std::filesystem::exists(path, ignored);
}

struct GdalClose {
    void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};
using GdalDataset = std::unique_ptr<GDALDataset, GdalClose>;

}  // namespace osgbindem

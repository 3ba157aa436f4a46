// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Failure.h"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <filesystem>
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

/// A reference system, or a part of one, as text.
template <typename Reference>
[[nodiscard]] std::string wktOf(const Reference& reference) {
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

using GdalDataset = GDALDatasetUniquePtr;

/// Runs one of GDAL's utilities with the words of its command line. `New`, `Free`: make and delete its options.
/// `what`: what it is run for, as in "cannot warp the raster". Throws Failure with that message.
template <auto New, auto Free, typename Run>
[[nodiscard]] GdalDataset madeBy(const CPLStringList& words, const std::string& what, const Run& run) {
    auto* options = New(const_cast<char**>(words.List()), nullptr);
    int usageError = 0;
    GdalDataset result(GDALDataset::FromHandle(run(options, &usageError)));
    Free(options);
    if (!result) throw osgAnalyticBin::support::Failure("cannot " + what + ": " + gdalMessage());
    return result;
}

}  // namespace osgbindem

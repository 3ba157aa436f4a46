// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Gdal.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace osgbindem {

std::string gdalMessage() {
    std::string text = CPLGetLastErrorMsg();
    if (text.empty()) text = "not a raster that GDAL reads";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string wktOf(const OGRSpatialReference& reference) {
    char* text = nullptr;
    reference.exportToWkt(&text);
    std::string result(text);
    CPLFree(text);
    return result;
}

const OGRSpatialReference* referenceOf(GDALDataset& dataset) {
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    return reference != nullptr ? reference : dataset.GetGCPSpatialRef();
}

bool mayExist(const std::string& path) {
    std::error_code ignored;
    return path.rfind("/vsi", 0) == 0 || std::filesystem::exists(path, ignored);
}

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Gdal.h"

#include <string>

namespace osgbindem {

/// The colours of a raster as bands of bytes: red, green, blue or grey, and alpha where there is any. `file`: has to
/// last as long. Returns: an empty pointer where the file has them so. Throws Failure.
[[nodiscard]] GdalDataset coloursOf(GDALDataset& file, const std::string& path);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"
#include "Settings.h"
#include "TileLayout.h"

#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// Everything that decides the bytes of a database, as text: programs, settings, and each raster's files with their
/// sizes and times. Two runs with the same text build the same files.
[[nodiscard]] std::string describeSources(const Settings& settings, const TileLayout& layout);

/// Where heights, how fine they are, or colours may have changed since a database was built: rectangles of posts, with
/// the cells between them and their neighbours.
using ChangedArea = std::vector<RectDeg>;

/// Whether one of them has a point in common with the rectangle; longitudes count modulo 360, a pole is one point.
[[nodiscard]] bool touches(const ChangedArea& area, const RectDeg& rect) noexcept;

/// Compares the descriptions of two databases. Returns: nullopt when more than rasters and images differs.
[[nodiscard]] std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now);

}  // namespace osgbindem

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

/// Where heights, how fine they are, or colours may have changed since a database was built.
class ChangedArea final {
public:
    /// A rectangle of which posts may have changed, with the cells between them and their neighbours.
    void add(const RectDeg& rect) { _rects.push_back(rect); }

    [[nodiscard]] bool empty() const noexcept { return _rects.empty(); }

    /// Whether the rectangles have a point in common; longitudes count modulo 360, a pole is one point.
    [[nodiscard]] bool touches(const RectDeg& rect) const noexcept;

private:
    std::vector<RectDeg> _rects;
};

/// Everything that decides the bytes of a database, as text: programs, settings, and each raster's files with their
/// sizes and times. Two runs with the same text build the same files.
[[nodiscard]] std::string describeSources(const Settings& settings, const TileLayout& layout);

/// Where a database may differ from one that would be built now, by their descriptions.
/// Returns: nullopt when more than rasters and images differs.
[[nodiscard]] std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace osgbindem {

using Rgb = std::array<std::uint8_t, 3>;

/// The colour of a height: blues below 0 m, greens to browns to white above.
[[nodiscard]] Rgb hypsometricColour(double height) noexcept;

/// The same colours as a table.
[[nodiscard]] std::vector<osgAnalyticBin::TerrainGrid::ColourStop> hypsometricStops();

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"

#include <glm/vec3.hpp>

#include <vector>

namespace osgAnalyticBin {

/// The colours of heights: blues below 0 m, greens to browns to white above.
[[nodiscard]] const std::vector<TerrainGrid::ColourStop>& hypsometricStops();

/// Height in metres above which snow stays, about as on earth; below 0 where all land is white.
[[nodiscard]] double snowLine(double latitudeDeg) noexcept;

/// Share of snow on the ground, 0 to 1: none in the sea, less on steep ground.
/// `normalLocal`: unit length, in east, north, up.
[[nodiscard]] double snowShare(double height, double snowLine, const glm::dvec3& normalLocal) noexcept;

/// Factor of the brightness of ground that is lit from the north-west, 1 where it is level.
/// `exaggeration`: of its slope.
[[nodiscard]] double shadeOf(const glm::dvec3& normalLocal, double exaggeration) noexcept;

/// How much slopes are exaggerated for posts at this distance in metres: coarse grids know gentle slopes only.
[[nodiscard]] double exaggerationFor(double spacing) noexcept;

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "SkirtMeasure.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/TerrainGrid.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace osgbindem {

/// The tile as it is stored, but for its colours. Heights and skirts are in whole steps; skirts are rounded up.
[[nodiscard]] osgAnalyticBin::TerrainGrid gridOf(const HeightGrid& heights, const Skirt& skirt,
                                                 const TileLayout& layout);

/// Where a mesh lies.
struct MeshExtent {
    osgAnalyticBin::AnalyticBin bin;  ///< of everything the mesh draws
    double surfaceLow;                ///< metres; nothing but skirts is lower, the bin's margin apart
};

/// Of the grid's mesh as its float vertices draw it.
/// Guarantee: the bin holds every point of every triangle; the margin covers vertices at the axis, which have no
/// longitude.
[[nodiscard]] MeshExtent extentOf(const osgAnalyticBin::TerrainGrid& grid, const std::vector<std::uint16_t>& triangles,
                                  const TileId& tile, const TileLayout& layout);

}  // namespace osgbindem

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "SkirtMeasure.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace osgbindem {

/// A tile's vertices and normals in ECEF.
struct TileMesh {
    TileMesh(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout);

    /// The point in ECEF from which vertices are stored as floats; a multiple of the level's quantum.
    glm::dvec3 originEcef{0.0};
    /// Multiples of the level's quantum.
    std::vector<glm::dvec3> verticesEcef;
    std::vector<glm::vec3> normals;

private:
    void addSurface(const HeightGrid& heights, const TileLayout& layout);
    void addSkirts(const HeightGrid& heights, const Skirt& skirt, const TileLayout& layout);
    void placeOrigin(const HeightGrid& heights, const TileLayout& layout);
};

/// Where a mesh lies.
struct MeshExtent {
    osgAnalyticBin::AnalyticBin bin;  ///< of everything the mesh draws
    double surfaceLow;                ///< metres; nothing but skirts is lower, the bin's margin apart
};

/// Of a mesh as its float vertices draw it.
/// Guarantee: the bin holds every point of every triangle; the margin covers vertices at the axis, which have no
/// longitude.
[[nodiscard]] MeshExtent extentOf(const TileMesh& mesh, const std::vector<std::uint16_t>& triangles, const TileId& tile,
                                  const TileLayout& layout);

}  // namespace osgbindem

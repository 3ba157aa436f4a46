// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>

namespace osgAnalyticBin {

/// What osgTerrain::Terrain says about the meshes of its tiles while they are shown.
struct TerrainShape {
    /// osgTerrain::Terrain::setVerticalScale().
    double verticalScale = 1.0;
    /// osgTerrain::Terrain::setSampleRatio().
    double sampleRatio = 1.0;
    bool areBoundariesEqual = false;  ///< Whether edges lie half way to the heights of neighbours.
    /// The greatest distance in metres between what is drawn and the meshes of osgTerrain::GeometryTechnique; 0: these
    /// meshes are drawn; infinity: nothing is known.
    double techniqueMargin = 0.0;

    /// Whether it is known where the meshes are.
    [[nodiscard]] bool isKnown() const { return std::isfinite(techniqueMargin); }

    /// Whether the meshes have the same shape.
    [[nodiscard]] bool operator==(const TerrainShape& other) const {
        return verticalScale == other.verticalScale && sampleRatio == other.sampleRatio &&
               areBoundariesEqual == other.areBoundariesEqual && techniqueMargin == other.techniqueMargin;
    }
};

}  // namespace osgAnalyticBin

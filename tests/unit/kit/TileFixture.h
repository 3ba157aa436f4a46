// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <functional>
#include <vector>

namespace osgAnalyticBin::test {

using EcefTriangle = std::array<glm::dvec3, 3>;

/// What a subgraph draws, in ECEF.
struct DrawnTriangles {
    std::vector<EcefTriangle> surface;
    std::vector<EcefTriangle> skirts;  // of quad strips, as osgTerrain makes them
};

[[nodiscard]] DrawnTriangles drawnTriangles(osg::Node& node, const osg::Matrixd& localToEcef = osg::Matrixd());

/// The triangles that osgTerrain::GeometryTechnique makes of a copy of the tile.
[[nodiscard]] DrawnTriangles drawnTriangles(const osgTerrain::TerrainTile& tile, float verticalScale,
                                            float sampleRatio = 1.0f);

/// A terrain tile with extents in degrees and heights by column and row.
[[nodiscard]] osg::ref_ptr<osgTerrain::TerrainTile> makeTerrainTile(
    const core::GeodeticBin& extents, unsigned int columns, unsigned int rows,
    const std::function<float(unsigned int, unsigned int)>& height);

/// Points all over the triangles, corners and edges included.
[[nodiscard]] std::vector<glm::dvec3> samplesOf(const std::vector<EcefTriangle>& triangles, int steps = 6);

/// Where a graphics driver draws a vertex, in the vertex's frame: it rounds the matrix and all sums to float.
[[nodiscard]] osg::Vec3d drawnByFloats(const osg::Vec3& vertex, const osg::Matrixd& modelView);

/// Metres by which a point is outside of a bin, its margin left out; 0 inside.
[[nodiscard]] double metresOutside(const AnalyticBin& bin, const glm::dvec3& ecef, const core::Ellipsoid& ellipsoid);

/// The largest of all.
[[nodiscard]] double metresOutside(const AnalyticBin& bin, const std::vector<glm::dvec3>& points,
                                   const core::Ellipsoid& ellipsoid);

}  // namespace osgAnalyticBin::test

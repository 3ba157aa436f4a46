// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Vec2>

namespace osgAnalyticBin {

/// The triangles of one drawable in ECEF; lines and points are triangles without area.
struct SurfaceMesh : core::EcefMesh {
    /// One for each vertex, or null.
    const osg::Vec2* texCoords = nullptr;
};

/// Whether a drawable draws its vertices and nothing else, as far as its class and its callbacks tell.
[[nodiscard]] bool isDrawnByItsVertices(const osg::Drawable& drawable);

/// Reads a drawable, whose frame `localToEcef` takes to ECEF, in place of what the mesh held. A driver may divide a
/// quad along either diagonal: `withBothDiagonals`, the triangles of both are read, otherwise those that OSG takes.
/// Returns: false when what it draws cannot be told: no vertices that can be read, an index beyond them, instances,
/// primitives of a class that is not known.
[[nodiscard]] bool readMesh(const osg::Drawable& drawable, const osg::Matrixd& localToEcef, SurfaceMesh& mesh,
                            bool withBothDiagonals = false);

/// Metres from the origin of the frame `localToEcef` to the farthest vertex.
[[nodiscard]] double farthestVertex(const SurfaceMesh& mesh, const osg::Matrixd& localToEcef);

/// Puts any other vertex in place of those that no triangle uses. Requires: a triangle.
void dropUnusedVertices(SurfaceMesh& mesh);

}  // namespace osgAnalyticBin

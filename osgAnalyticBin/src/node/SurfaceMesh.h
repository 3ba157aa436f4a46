// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Vec2>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// The triangles of one drawable in ECEF; lines and points are triangles without area.
struct SurfaceMesh {
    std::vector<double> x, y, z;
    std::vector<std::uint32_t> triangles;
    /// One for each vertex, or null.
    const osg::Vec2* texCoords = nullptr;

    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::dvec3 vertex(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Reads a drawable, whose frame `localToEcef` takes to ECEF, in place of what the mesh held.
/// Returns: false when what it draws cannot be told: no vertices that can be read, an index beyond them, instances.
[[nodiscard]] bool readMesh(const osg::Drawable& drawable, const osg::Matrixd& localToEcef, SurfaceMesh& mesh);

}  // namespace osgAnalyticBin

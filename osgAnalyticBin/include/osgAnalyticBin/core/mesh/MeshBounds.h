// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::core {

/// A triangle mesh in ECEF metres; each coordinate has its array. Every vertex counts, whether triangles use it or not.
struct EcefMesh {
    /// @{
    /// Of the vertices.
    std::vector<double> x, y, z;
    /// @}
    /// Three indices of vertices a triangle.
    std::vector<std::uint32_t> triangles;

    /// Number of vertices.
    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
    /// Requires: i < size().
    [[nodiscard]] glm::dvec3 vertex(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
};

/// The bin of any triangle mesh. It holds the whole triangles, not only their vertices.
/// Most meshes of terrain are bounded by closed formulas, without iteration; trigonometry is used a few times for the
/// whole mesh. That bin is at most some 0.5 m too deep, 0.5 m too high and 1e-7 radians too wide. GeodeticMeshBounds
/// bounds the other meshes: those with sides of more than 1500 km or altitudes beyond 100 km, those that wrap half the
/// globe, and those on an ellipsoid with |a2/b2 - 1| > 0.01. Lengths here are those of the earth in metres; on another
/// globe, or in another unit, they are to be multiplied by its equatorial radius over the earth's, 6378137. Guarantee:
/// on any ellipsoid in any unit, bin() holds every point of every triangle, or is empty, which means not known;
/// vertices within 1 m of the axis may leave it by that much; tests: MeshBounds.*, PlanetMeshes.*. Cost: some 10
/// nanoseconds for each vertex and each triangle with closed formulas, many times that otherwise. An object that is
/// used for many meshes keeps its memory. Source: doc/theory/derivation.md, sections 5 and 11.
class MeshBounds final {
public:
    MeshBounds() = default;
    /// Calls find().
    MeshBounds(const Ellipsoid& ellipsoid, const EcefMesh& mesh) { find(ellipsoid, mesh); }

    /// Replaces the bin that was found before. Requires: indices within the vertices.
    void find(const Ellipsoid& ellipsoid, const EcefMesh& mesh);

    /// Empty for meshes without vertices, with numbers that are not finite, or that may reach deeper than the
    /// ellipsoid's smallest radius of curvature.
    [[nodiscard]] const GeodeticBin& bin() const noexcept { return _bin; }

    /// Whether the bin was found by closed formulas.
    [[nodiscard]] bool isQuick() const noexcept { return _isQuick; }

    /// Whether a vertex lies within 1 m of the axis.
    [[nodiscard]] bool touchesAxis() const noexcept { return _axisError > 0.0; }
    /// Metres by which vertices near the axis may leave the bin; 0 where the mesh does not touch the axis.
    [[nodiscard]] double axisError() const noexcept { return _axisError; }

    /// @{
    /// Metres, of each vertex, up to altitudeError(). Of a bin that is not empty.
    [[nodiscard]] const std::vector<double>& altitudes() const noexcept { return _altitudes; }
    [[nodiscard]] double altitudeError() const noexcept { return _altitudeError; }
    /// @}

    /// Metres that chords may sag below the lowest corner of their triangle at most.
    [[nodiscard]] double sag() const noexcept { return _sag; }

private:
    void findInMap(const EcefMesh& mesh);
    [[nodiscard]] bool findInClosedForm(const Ellipsoid& ellipsoid, const EcefMesh& mesh);
    void findByTriangles(const Ellipsoid& ellipsoid, const EcefMesh& mesh);

    GeodeticBin _bin;
    std::vector<double> _altitudes;
    std::vector<double> _axisDistances;
    std::vector<double> _excess[2];
    double _altitudeError = 0.0;
    double _sag = 0.0;
    double _axisError = 0.0;
    bool _isQuick = false;
};

}  // namespace osgAnalyticBin::core

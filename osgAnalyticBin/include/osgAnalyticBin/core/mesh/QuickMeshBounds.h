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

/// The bin that GeodeticMeshBounds finds, some 0.5 m deeper and higher and 1e-7 radians wider, in a small part of the
/// time: no iteration, and no trigonometry but for the whole mesh. Lengths here are those of the earth in metres; on
/// another globe, or in another unit, they are to be multiplied by its equatorial radius over the earth's, 6378137.
/// Guarantee: on any ellipsoid in any unit, bin() holds every point of every triangle, or is empty, which means not
/// known; vertices within 1 m of the axis may leave it by that much; tests: QuickMeshBounds.*, PlanetMeshes.*.
/// Cost: some 10 nanoseconds for each vertex and each triangle. One object for many meshes keeps its memory.
/// Source: doc/derivation.md, section 11.
class QuickMeshBounds final {
public:
    QuickMeshBounds() = default;
    /// Finds the bin at once; see find().
    QuickMeshBounds(const Ellipsoid& ellipsoid, const EcefMesh& mesh) { find(ellipsoid, mesh); }

    /// In place of what was found before. Requires: indices within the vertices.
    void find(const Ellipsoid& ellipsoid, const EcefMesh& mesh);

    /// False: sides of more than 1500 km, altitudes beyond 100 km, a mesh that wraps half the globe, or an ellipsoid
    /// that is not nearly a sphere, |a2/b2 - 1| > 0.01; bin() is empty then, and GeodeticMeshBounds is to be asked.
    [[nodiscard]] bool isKnown() const noexcept { return !_bin.empty(); }

    /// Empty unless isKnown().
    [[nodiscard]] const GeodeticBin& bin() const noexcept { return _bin; }

    /// Some vertex lies within 1 m of the axis.
    [[nodiscard]] bool touchesAxis() const noexcept { return _touchesAxis; }

    /// Metres, of each vertex, up to altitudeError().
    [[nodiscard]] const std::vector<double>& altitudes() const noexcept { return _altitudes; }
    /// Metres.
    [[nodiscard]] double altitudeError() const noexcept { return _altitudeError; }

    /// Metres that chords may sag below the lowest corner of their triangle at most.
    [[nodiscard]] double sag() const noexcept { return _sag; }

private:
    GeodeticBin _bin;
    std::vector<double> _altitudes;
    std::vector<double> _axisDistances;
    std::vector<double> _excess[2];
    double _altitudeError = 0.0;
    double _sag = 0.0;
    bool _touchesAxis = false;
};

}  // namespace osgAnalyticBin::core

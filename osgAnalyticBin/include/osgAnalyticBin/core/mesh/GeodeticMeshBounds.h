// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

namespace osgAnalyticBin::core {

/// Finds the bin of a triangle mesh in ECEF. The bin holds whole triangles: chords sag below the ellipsoid, and a chord
/// between two posts of one parallel runs poleward of it.
/// Guarantee: on any ellipsoid in any unit, bin() holds every point of every triangle added, up to 1.6e-14 of the
/// larger radius (1e-7 m on the earth), or is empty, which means not known: for a mesh that may reach deeper than the
/// ellipsoid's smallest radius of curvature; tests: PlanetMeshes.ThoroughBoundsHoldEveryPoint.
/// A mesh that crosses the meridian opposite the reference longitude, or the axis, gets the full circle.
/// Source: doc/theory/derivation.md, section 5.
class GeodeticMeshBounds final {
public:
    /// The cone of all positions at one latitude.
    class LatitudeCone final {
    public:
        /// `latitude`: radians.
        LatitudeCone(const Ellipsoid& ellipsoid, double latitude) noexcept;
        /// Metres by which a point is beyond the cone, towards the north pole; negative: within.
        [[nodiscard]] double excess(double axisDistance, double z) const noexcept {
            return z * _cos - axisDistance * _sin + _offset;
        }

    private:
        double _sin, _cos, _offset;
    };

    /// Longitudes are measured from the reference, which should be near the middle of the mesh.
    /// Vertices closer to the axis than `axisTolerance` (in the ellipsoid's unit) have no longitude of their own and
    /// are taken at that of the others; the caller's margin has to cover the tolerance.
    GeodeticMeshBounds(const Ellipsoid& ellipsoid, double referenceLongitude, double axisTolerance = 0.0) noexcept;

    /// Every vertex of the mesh has to be added, each once.
    void expandByVertex(const glm::dvec3& ecef) noexcept;

    /// Every triangle has to be added, after its vertices.
    void expandByTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept;

    /// Empty before the first vertex, and for meshes that are too deep.
    [[nodiscard]] GeodeticBin bin() const noexcept;

private:
    void noteCrossing(const glm::dvec3 (&corners)[3]) noexcept;
    void raiseNorth(double latitude) noexcept;
    void lowerSouth(double latitude) noexcept;

    Ellipsoid _ellipsoid;
    double _referenceLongitude;
    glm::dvec3 _reference;
    double _axisTolerance;
    Interval _latitude;
    Interval _relativeLongitude;
    Interval _altitude;
    // Each in the half of its own sign, as if that were the northern one: what lies below needs no closer look.
    LatitudeCone _northCone, _southCone;
    bool _fullCircle = false;
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

namespace osgAnalyticBin::core {

/// A position as latitude and longitude in radians and altitude in metres above the ellipsoid.
struct Geodetic {
    /// Radians, north positive.
    double latitude = 0.0;
    /// Radians, east positive.
    double longitude = 0.0;
    /// Metres.
    double altitude = 0.0;
};

/// An ellipsoid of revolution about the z axis, oblate, prolate or a sphere, in earth-centred earth-fixed
/// (ECEF) coordinates; or the plane z = 0 of a map, in the map's coordinates and units, which stand for ECEF and metres
/// then. Positions in a map have angles, too: x is the longitude and y the latitude, times kMapUnitsInRadian. This is
/// the limit of ellipsoids that are large: an upper bound of what the curvature of an ellipsoid with that radius does
/// holds for the plane.
/// Requires: both radii finite and positive, or both infinite for a plane (asserted).
class Ellipsoid final {
public:
    /// Of map units. A power of two, so that converting does not round; in the angles of positions on the earth, maps
    /// in metres, feet or degrees are small.
    static constexpr double kMapUnitsInRadian = 8589934592.0;
    /// Map units. What is farther away along x or y has no bin, because latitudes end at the poles.
    static constexpr double kFarthestInMap = kMapUnitsInRadian;

    /// Metres.
    Ellipsoid(double equatorialRadius, double polarRadius) noexcept;

    /// The plane of a map.
    [[nodiscard]] static Ellipsoid plane() noexcept;
    /// Whether it is the plane of a map. Its radii are kMapUnitsInRadian.
    [[nodiscard]] bool isPlane() const noexcept { return _isPlane; }

    /// a, metres.
    [[nodiscard]] double equatorialRadius() const noexcept { return _a; }
    /// b, metres.
    [[nodiscard]] double polarRadius() const noexcept { return _b; }

    /// e2 = 1 - b2/a2: zero for a sphere, negative for a prolate ellipsoid.
    [[nodiscard]] double eccentricitySquared() const noexcept { return _e2; }

    /// b2/a2. It keeps its digits on flat ellipsoids, where 1 - e2 loses them.
    [[nodiscard]] double squaredRatio() const noexcept { return _squaredRatio; }

    /// w = cos2 + b2/a2 sin2, which is 1 - e2 sin2 without the difference: N = a / sqrt(w), M = b2/a / sqrt(w)3.
    [[nodiscard]] double curvatureTerm(double sinLatitude, double cosLatitude) const noexcept {
        return cosLatitude * cosLatitude + _squaredRatio * (sinLatitude * sinLatitude);
    }

    /// N, the radius of curvature across the meridian, at the latitude with the given sine and cosine.
    [[nodiscard]] double primeVerticalRadius(double sinLatitude, double cosLatitude) const noexcept;

    /// M, the radius of curvature along the meridian, at the latitude with the given sine and cosine.
    [[nodiscard]] double meridionalRadius(double sinLatitude, double cosLatitude) const noexcept;

    /// The outward normal at a latitude and longitude, of unit length.
    [[nodiscard]] glm::dvec3 up(double latitude, double longitude) const noexcept;

    /// Converts to ECEF metres. In a map without rounding, as long as no number is subnormal.
    /// Source: [DMA] geodetic to rectangular; doc/theory/derivation.md, section 1.
    /// Guarantee: within 16 epsilon of the larger radius plus the altitude, for b/a from 0.01 to 100;
    /// tests: Ellipsoid.ConvertsLikeLongDouble*.
    [[nodiscard]] glm::dvec3 toEcef(const Geodetic& position) const noexcept;

    /// Converts from ECEF metres; longitude in [-pi, pi], on the axis 0. A point deeper than the centres of curvature
    /// has several positions: the result is one nearest to the surface, on the equator's plane the northern one.
    /// Source: [E13]; doc/theory/derivation.md, section 1.
    /// Guarantee: toEcef(result) within 3 epsilon of the point's distance from the centre plus the largest radius of
    /// curvature, max(a, a2/b, b2/a), for every finite point and b/a from 0.01 to 100: on earth-like ellipsoids
    /// (|e2| < 0.01) within 1e-8 m up to 7000 km from the centre;
    /// tests: Ellipsoid.ReturnsToTheSamePoint*, Ellipsoid.ReturnsToTheSamePosition*.
    /// Cost: three or four steps of five divisions near the surface, a hundred at most; two arctangents.
    [[nodiscard]] Geodetic toGeodetic(const glm::dvec3& ecef) const noexcept;

    /// The largest value of n.x over the solid ellipsoid: sqrt(a2 (nx2 + ny2) + b2 nz2).
    /// Requires: no plane.
    [[nodiscard]] double support(const glm::dvec3& direction) const noexcept;

    /// Whether both radii are the same numbers.
    [[nodiscard]] bool operator==(const Ellipsoid& other) const noexcept {
        return _a == other._a && _b == other._b && _isPlane == other._isPlane;
    }
    /// Whether a radius differs.
    [[nodiscard]] bool operator!=(const Ellipsoid& other) const noexcept { return !(*this == other); }

private:
    double _a;
    double _b;
    double _squaredRatio;
    double _e2;
    bool _isPlane;
};

}  // namespace osgAnalyticBin::core

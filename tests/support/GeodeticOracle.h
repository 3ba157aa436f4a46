// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>

namespace osgAnalyticBin::test {

/// The oracle computes in long double and shares no code with the core.
using Real = long double;

struct RealVector {
    Real x = 0, y = 0, z = 0;
};

[[nodiscard]] inline RealVector operator+(const RealVector& a, const RealVector& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline RealVector operator-(const RealVector& a, const RealVector& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline RealVector operator*(Real s, const RealVector& a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] inline Real dot(const RealVector& a, const RealVector& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] Real length(const RealVector& a) noexcept;
[[nodiscard]] inline RealVector cross(const RealVector& a, const RealVector& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[nodiscard]] inline RealVector real(const glm::dvec3& v) noexcept {
    return {v.x, v.y, v.z};
}
[[nodiscard]] glm::dvec3 rounded(const RealVector& v) noexcept;

struct RealRange {
    Real lower = 0, upper = 0;

    [[nodiscard]] Real width() const noexcept { return upper - lower; }
};

[[nodiscard]] RealVector geodeticToEcef(const core::Ellipsoid& ellipsoid, Real latitude, Real longitude,
                                        Real altitude) noexcept;
[[nodiscard]] inline RealVector geodeticToEcef(const core::Ellipsoid& ellipsoid,
                                               const core::Geodetic& position) noexcept {
    return geodeticToEcef(ellipsoid, position.latitude, position.longitude, position.altitude);
}

struct RealGeodetic {
    Real latitude = 0, longitude = 0, altitude = 0;
};

/// The inverse, to the nearest point of the ellipsoid, iterated until it stands still; longitude 0 on the axis.
[[nodiscard]] RealGeodetic ecefToGeodetic(const core::Ellipsoid& ellipsoid, const RealVector& point) noexcept;

/// normal.x + offset without the rounding of double.
[[nodiscard]] Real exactDistance(const core::Plane& plane, const RealVector& point) noexcept;

/// The exact range of n.x over all points of a geodetic bin, in closed form: no series, no sampling.
/// Source: doc/theory/derivation.md, section 8.
/// Guarantee: correct to rounding() for altitudes above minus the smallest radius of curvature.
/// Requires: the bin is not empty.
class BinOracle final {
public:
    BinOracle(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept;

    [[nodiscard]] const core::Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }
    [[nodiscard]] const core::GeodeticBin& bin() const noexcept { return _bin; }

    /// The range of direction.x; the direction need not be of unit length.
    [[nodiscard]] RealRange range(const glm::dvec3& direction) const noexcept;

    /// The range of the signed distance.
    [[nodiscard]] RealRange distanceRange(const core::Plane& plane) const noexcept;

    /// What the oracle's own long double arithmetic may be off by, in metres: 64 of its epsilons times the largest
    /// coordinate and the plane's offset.
    [[nodiscard]] Real rounding(const core::Plane& plane) const noexcept;

private:
    struct Angle {
        Real sine, cosine;
    };

    [[nodiscard]] Real largestAlongParallel(Real x, Real y) const noexcept;
    [[nodiscard]] Real maximum(const RealVector& direction) const noexcept;

    core::Ellipsoid _ellipsoid;
    core::GeodeticBin _bin;
    bool _fullCircle;
    Real _a2, _b2;
    // The longitude interval is cut into parts of less than half a turn.
    static constexpr std::size_t kMostParts = 4;
    std::size_t _parts;
    std::array<Angle, kMostParts + 1> _longitudes;
    std::array<Angle, 2> _latitudes;
    std::array<Real, 2> _rho;     // N cos p at the southern and northern edge
    std::array<Real, 2> _height;  // N (1 - e2) sin p there
};

/// The range of the signed distance over a grid of positions, its extrema followed downhill and uphill: a second
/// oracle, which never leaves the true range (but for rounding) and comes close to it.
[[nodiscard]] RealRange sampledDistanceRange(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                             const core::Plane& plane, int steps);

}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

struct Triangle {
    glm::dvec3 a, b, c;
};

/// Corners and edges more often than chance has it.
inline RealVector randomPointOf(Random& random, const Triangle& triangle) {
    Real u = random.uniform();
    Real v = random.uniform();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    if (random.chance(0.3)) u = 0;
    if (random.chance(0.3)) v = random.chance(0.5) ? 0 : 1 - u;
    return (1 - u - v) * real(triangle.a) + u * real(triangle.b) + v * real(triangle.c);
}

/// How far a point is outside of the bin, in metres along the coordinate where it is worst.
inline Real distanceOutside(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const RealVector& point) {
    const RealGeodetic at = ecefToGeodetic(ellipsoid, point);
    const Real radius = ellipsoid.equatorialRadius();
    const Real north = std::max(at.latitude - bin.latitude().upper, bin.latitude().lower - at.latitude) * radius;
    const Real above = std::max(at.altitude - bin.altitude().upper, bin.altitude().lower - at.altitude);
    Real east = 0;
    if (!bin.isFullCircle()) {
        const Real fromMiddle = std::remainder(at.longitude - bin.longitude().middle(), 2 * 3.14159265358979323846L);
        const Real rho = std::hypot(point.x, point.y);
        east = (std::abs(fromMiddle) - static_cast<Real>(bin.longitude().width()) / 2) * rho;
    }
    return std::max({north, east, above});
}

}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <support/Random.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

// Radians by which a position may be beside a region and count as over it: rounding of the conversion.
inline constexpr double kOverRegion = 1e-10;

inline core::Ellipsoid randomGlobe(Random& random) {
    if (random.chance(0.5)) return wgs84();
    const double a = random.logUniform(1e5, 1e8);
    return {a, a * std::sqrt(1.0 - random.uniform(-0.01, 0.01))};
}

// Some touch a pole, go round the globe, or end at the equator.
inline core::GeodeticBin randomRegion(Random& random) {
    const double height = random.logUniform(1e-4, kPi), width = random.logUniform(1e-4, 2.0 * kPi);
    double south = random.uniform(-kHalfPi, kHalfPi);
    if (random.chance(0.1)) south = 0.0;
    if (random.chance(0.1)) south = -height;
    if (random.chance(0.1)) south = kHalfPi - height;
    const double west = random.uniform(-kPi, kPi);
    const bool isFullCircle = random.chance(0.15);
    return {{south, south + height}, {west, west + (isFullCircle ? 2.0 * kPi : width)}, {0.0, 0.0}};
}

inline bool isOver(const core::GeodeticBin& region, const core::Ellipsoid& ellipsoid, const glm::dvec3& point) {
    const core::Geodetic at = ellipsoid.toGeodetic(point);
    const core::Interval& latitude = region.latitude();
    if (at.latitude < latitude.lower - kOverRegion || at.latitude > latitude.upper + kOverRegion) return false;
    // longitudes mean little near the axis
    const double slack = kOverRegion / std::max(1e-6, std::cos(at.latitude));
    const double aside = std::remainder(at.longitude - region.longitude().middle(), 2.0 * kPi);
    return std::abs(aside) <= 0.5 * region.longitude().width() + slack;
}

inline bool isSegmentOver(const core::GeodeticBin& region, const core::Ellipsoid& ellipsoid, const glm::dvec3& from,
                          const glm::dvec3& to) {
    constexpr int kSteps = 48;
    for (int step = 0; step <= kSteps; ++step) {
        if (!isOver(region, ellipsoid, glm::mix(from, to, static_cast<double>(step) / kSteps))) return false;
    }
    return true;
}

}  // namespace osgAnalyticBin::test

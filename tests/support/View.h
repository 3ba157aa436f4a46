// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <support/GeodeticOracle.h>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::test {

/// A camera with a square picture. Perspective: the half width is the tangent of half the field of view; orthographic:
/// metres. Near and far are distances along the view; infinite ones make no plane.
struct View {
    glm::dvec3 eye{0.0};
    glm::dvec3 forward{1.0, 0.0, 0.0}, right{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};
    double halfWidth = 0.5;
    bool orthographic = false;
    double nearDistance = -std::numeric_limits<double>::infinity();
    double farDistance = std::numeric_limits<double>::infinity();

    /// Turns the camera to look along a direction, rolled at random.
    void lookAlong(const glm::dvec3& direction, Random& random) noexcept;

    /// Left, right, bottom, top, and near and far where there are.
    [[nodiscard]] std::vector<core::Plane> planes() const;
};

/// A point of the bin where direction.x is largest, by angles, not as the core does it.
[[nodiscard]] RealVector farthestPoint(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                       const RealVector& direction) noexcept;

/// Whether the convex hull of the bin meets the frustum, by libccd's GJK. What lies farther than the whole bin is cut
/// off.
[[nodiscard]] bool hullsMeet(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const View& view);

/// Whether the segment misses the ellipsoid scaled by 1 - depth / smaller radius (for negative depths: larger),
/// exactly.
[[nodiscard]] bool segmentMissesOccluder(const core::Ellipsoid& ellipsoid, double depth, const RealVector& from,
                                         const RealVector& to) noexcept;

/// The same for the half line from a point along a direction.
[[nodiscard]] bool halfLineMissesOccluder(const core::Ellipsoid& ellipsoid, double depth, const RealVector& from,
                                          const RealVector& direction) noexcept;

}  // namespace osgAnalyticBin::test

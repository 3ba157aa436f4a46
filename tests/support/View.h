// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <support/RandomBins.h>
#include <vector>

namespace osgAnalyticBin::test {

/// A camera with a square picture. Perspective: the half width is the tangent of half the field of view; orthographic:
/// metres. Near and far are distances along the view; infinite ones make no plane.
struct View {
    glm::dvec3 eye{0.0};
    glm::dvec3 forward{1.0, 0.0, 0.0}, right{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};
    double halfWidth = 0.5;
    bool orthographic = false;
    double nearDistance = -kInfinity;
    double farDistance = kInfinity;

    /// Turns the camera to look along a direction, rolled at random.
    void lookAlong(const glm::dvec3& direction, Random& random) noexcept;

    /// Left, right, bottom, top, and near and far where there are.
    [[nodiscard]] std::vector<core::Plane> planes() const;
};

/// A point of the bin where direction.x is largest, by angles, not as the core does it.
[[nodiscard]] RealVector farthestPoint(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                       const RealVector& direction) noexcept;

/// Whether the convex hull of the bin meets the frustum, by libccd's GJK. What lies behind the whole bin is cut off.
[[nodiscard]] bool hullsMeet(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const View& view);

/// Whether the segment misses the ellipsoid scaled by 1 - depth / smaller radius (negative depths: larger), exactly.
[[nodiscard]] bool segmentMissesOccluder(const core::Ellipsoid& ellipsoid, double depth, const RealVector& from,
                                         const RealVector& to) noexcept;

/// The same for the half line from a point along a direction.
[[nodiscard]] bool halfLineMissesOccluder(const core::Ellipsoid& ellipsoid, double depth, const RealVector& from,
                                          const RealVector& direction) noexcept;

/// The depth of an occluder: of terrain on earth mostly; above the ellipsoid, and of the coarsest meshes' sag.
[[nodiscard]] double randomDepth(Random& random) noexcept;

/// Just above the occluder, near the ground, over a pole, in orbit, up to 1e9 m away; seldom inside.
[[nodiscard]] glm::dvec3 randomEye(Random& random, const core::Ellipsoid& ellipsoid, double depth) noexcept;

/// A bin, a point of it or within its margin, and an eye that sees the point just past the occluder, or nearly so.
struct LineOfSight {
    core::Ellipsoid ellipsoid;
    core::GeodeticBin bin;
    double margin, depth;
    RealVector target;
    glm::dvec3 eye;
};
[[nodiscard]] LineOfSight randomLineOfSight(Random& random) noexcept;

/// Perspective or orthographic, wide or narrow, with or without near and far planes, at the target, beside it, or
/// anywhere; one in four stands in the target, a point of the bin, and looks away from one of the bin's faces.
[[nodiscard]] View randomView(Random& random, const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                              const RealVector& target) noexcept;

/// The planes moved inward or outward so that the point is inside each, of some by as little as 1e-9 m.
void moveToHold(Random& random, const RealVector& point, double size, std::vector<core::Plane>& planes) noexcept;

/// A point of the bin, or within the margin of one; often at an edge.
[[nodiscard]] RealVector randomPointWithin(Random& random, const core::Ellipsoid& ellipsoid,
                                           const core::GeodeticBin& bin, double margin) noexcept;

}  // namespace osgAnalyticBin::test

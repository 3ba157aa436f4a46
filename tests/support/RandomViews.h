// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <support/RandomBins.h>
#include <support/View.h>

namespace osgAnalyticBin::test {

/// The depth of an occluder: of terrain on earth mostly; above the ellipsoid, and of the coarsest meshes' sag.
[[nodiscard]] double randomDepth(Random& random) noexcept;

/// Just above the occluder, near the ground, over a pole, in orbit, up to 1e9 m away; seldom inside.
[[nodiscard]] glm::dvec3 randomEye(Random& random, const core::Ellipsoid& ellipsoid, double depth) noexcept;

/// A bin, a point of it or within the margin of one, and an eye that sees the point just past the occluder, or nearly
/// does.
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

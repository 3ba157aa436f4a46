// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How others cull tiles on WGS 84.

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace osgAnalyticBin::test {

/// A box along the axes of the middle, by exact supports, and a point that is hidden only when all of the tile is.
class BoxWithHorizonPoint {
public:
    /// `scale`: of the occluder, the ellipsoid's being 1.
    BoxWithHorizonPoint(const core::GeodeticBin& bin, double scale);

    [[nodiscard]] bool keeps(const std::vector<core::Plane>& planes, const glm::dvec3& eye) const;

private:
    std::array<glm::dvec3, 3> _axes;
    std::array<double, 3> _half{};
    glm::dvec3 _center{0.0}, _radii{0.0}, _point{0.0};
};

/// Whether planes keep the smallest sphere about the middle of the box that bounds the tile.
[[nodiscard]] bool sphereKeeps(const core::GeodeticBin& bin, const std::vector<core::Plane>& planes);

}  // namespace osgAnalyticBin::test

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// A body that holds a part of a bin: all points within `reach` metres of the convex hull of eight corners.
/// Source: doc/theory/occlusion.md, section 4.
struct BinHull {
    /// @{
    /// The corners: metres, in the frame that hullsOfQuarters() was given.
    std::array<double, 8> x, y, z;
    /// @}
    /// Metres.
    double reach;

    [[nodiscard]] glm::dvec3 corner(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
    void setCorner(std::size_t i, const glm::dvec3& at) noexcept { x[i] = at.x, y[i] = at.y, z[i] = at.z; }
};

/// The bodies that hold the south-western, south-eastern, north-western and north-eastern quarter of a bin. `margin`:
/// metres by which they extend beyond the bin. Their reach is infinite on ellipsoids whose squared eccentricity is not
/// between -0.01 and 0.01. Requires: a bin that is not empty.
/// Guarantee: each holds its quarter; test: BinHull.HoldsTheQuartersOfTheBin.
[[nodiscard]] std::array<BinHull, 4> hullsOfQuarters(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin,
                                                     const Frame& frame) noexcept;

/// A ball, in metres, in the coordinates of a frame.
struct BinBall {
    glm::dvec3 centre;
    double radius;
};

/// A ball that holds a bin with its margin, as hullsOfQuarters() does. It costs less, and is larger.
/// Guarantee: test: BinHull.HasABallAroundTheBin.
[[nodiscard]] BinBall ballAround(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin,
                                 const Frame& frame) noexcept;

}  // namespace osgAnalyticBin::core

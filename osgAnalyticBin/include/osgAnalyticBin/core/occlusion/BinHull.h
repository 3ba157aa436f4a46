// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <array>

namespace osgAnalyticBin::core {

/// A body that holds a part of a bin: all points within `reach` metres of the convex hull of eight corners.
/// Source: doc/theory/occlusion.md, section 4.
struct BinHull {
    /// Metres, in the frame that hullsOfQuarters() was given.
    std::array<glm::dvec3, 8> corners;
    /// Metres.
    double reach;
};

/// The bodies that hold the south-western, south-eastern, north-western and north-eastern quarter of a bin. `margin`:
/// metres by which they extend beyond the bin. Their reach is infinite on ellipsoids whose squared eccentricity is not
/// between -0.01 and 0.01. Requires: a bin that is not empty.
/// Guarantee: each holds its quarter; test: BinHull.HoldsTheQuartersOfTheBin.
[[nodiscard]] std::array<BinHull, 4> hullsOfQuarters(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin,
                                                     const Frame& frame) noexcept;

}  // namespace osgAnalyticBin::core

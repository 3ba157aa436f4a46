// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <array>

namespace osgAnalyticBin::core {

/// A body that holds a bin: all points within `reach` metres of the convex hull of the bin's corners, ECEF.
/// Source: doc/occlusion.md, section 4. Guarantee: it holds the bin; test: BinHull.HoldsTheBin.
struct BinHull {
    /// `margin`: metres by which the body extends beyond the bin. `reach` is infinite on ellipsoids whose squared
    /// eccentricity is not between -0.01 and 0.01. Requires: a bin that is not empty.
    BinHull(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept;

    /// ECEF, metres.
    std::array<glm::dvec3, 8> corners;
    /// Metres.
    double reach;
};

}  // namespace osgAnalyticBin::core

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
    /// `margin`: metres around the bin that belong to it. Requires: a bin that is not empty, and an ellipsoid whose
    /// eccentricity squared is between -0.01 and 0.01; elsewhere `reach` is infinite.
    BinHull(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept;

    /// ECEF, metres.
    std::array<glm::dvec3, 8> corners;
    /// Metres.
    double reach;
};

}  // namespace osgAnalyticBin::core

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
    /// The corners, in metres, in the coordinates of the frame that BinBody was given.
    std::array<double, 8> x, y, z;
    /// @}
    /// Metres.
    double reach;

    /// Requires, here and in setCorner(): i < 8.
    [[nodiscard]] glm::dvec3 corner(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
    /// Sets a corner.
    void setCorner(std::size_t i, const glm::dvec3& at) noexcept { x[i] = at.x, y[i] = at.y, z[i] = at.z; }
    /// Leaves out what is above `top`, but for the bin's floor. `altitude`: of the bin. Requires: top <=
    /// altitude.upper.
    void lowerTop(double top, const Interval& altitude) noexcept;
};

/// A ball, in metres, in the same coordinates.
struct BinBall {
    /// @{
    /// In metres.
    glm::dvec3 centre;
    double radius;
    /// @}
};

/// The body of a bin, in the coordinates of a frame. All but the frame has to live as long.
class BinBody final {
public:
    /// `margin`: metres by which it extends beyond the bin. Requires: a bin that is not empty.
    BinBody(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin, const InverseFrame& frame) noexcept;

    /// A ball that holds it.
    /// Guarantee: test: BinBody.IsInItsBall.
    [[nodiscard]] BinBall ball() const noexcept;

    /// Bodies that hold its south-western, south-eastern, north-western and north-eastern quarter. Their reach is
    /// infinite on ellipsoids whose squared eccentricity is not between -0.01 and 0.01, and for bins wider than a
    /// radian. Guarantee: each holds its quarter; test: BinBody.IsInTheHullsOfItsQuarters.
    [[nodiscard]] std::array<BinHull, 4> quarters() const noexcept;

private:
    [[nodiscard]] glm::dvec3 middle() const noexcept;
    [[nodiscard]] double largestRadius() const noexcept;

    const Ellipsoid& _ellipsoid;
    const GeodeticBin& _bin;
    double _margin;
    InverseFrame _frame;
    std::array<double, 4> _middle;  // sine and cosine of the middle latitude, then longitude
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <cmath>

namespace osgAnalyticBin::core {

/// The right-handed frame whose z points along `axis`, and x as nearly as possible along `zeroDirection`.
/// Requires: neither is zero, nor are they parallel.
[[nodiscard]] Frame frameAboutAxis(const glm::dvec3& origin, const glm::dvec3& axis,
                                   const glm::dvec3& zeroDirection) noexcept;

/// The formula of a cylinder's solid wall, for AutodiffMapping: (angle, radius, height) to
/// origin + radius (cos angle x + sin angle y) + height z. The parameter box chooses the piece: its radii are the wall.
/// Source: doc/theory/mappings.md, section 4.
/// Guarantee: the bound is attained, up to rounding; to 90 degrees the remainder is at most 1.25 times the model's
/// error; tests: CylinderSegment.*.
class CylinderSegment final {
public:
    /// The axis is the frame's z; angles are counted from its x towards its y.
    explicit CylinderSegment(const Frame& frame) noexcept : _frame(frame) {}

    /// Radians, metres, metres.
    template <class T>
    [[nodiscard]] Vec3<T> operator()(T angle, T radius, T height) const {
        using std::cos;
        using std::sin;
        return combined<T>(_frame.origin, radius * cos(angle), _frame.x, radius * sin(angle), _frame.y, height,
                           _frame.z);
    }

    /// See AnalyticMapping; holds for every box.
    [[nodiscard]] double remainder(const ParameterBox& box) const noexcept;

private:
    Frame _frame;
};

}  // namespace osgAnalyticBin::core

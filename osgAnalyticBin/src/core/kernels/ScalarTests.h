// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Constants.h"
#include "PlaneKernels.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/KernelData.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

/// The tests for doubles, one bin and one plane at a time.
namespace osgAnalyticBin::core::kernels::scalar {

// In this order.
// clang-format off
#include "ScalarNumbers.inl"
#include "QuadraticTest.inl"
#include "ExactTest.inl"
#include "HorizonTest.inl"
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES
// clang-format on

/// All stages but the exact range.
template <class Form>
[[nodiscard]] Sides<double> sidesOf(const double* numbers, const PlaneLanes<double>& plane) noexcept {
    Sides<double> sides = Sphere::sides(numbers, plane);
    if (sides.open) sides = Form::Coarse::sides(numbers, plane);
    if (sides.open) sides = Form::Fine::sides(numbers, plane);
    return sides;
}

[[nodiscard]] inline PlaneLanes<double> onePlane(const Plane& plane) noexcept {
    return {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, roundingOf(plane)};
}

[[nodiscard]] inline Side sideOf(const Sides<double>& sides) noexcept {
    return sides.outside ? Side::Outside : sides.inside ? Side::Inside : Side::Straddling;
}

}  // namespace osgAnalyticBin::core::kernels::scalar

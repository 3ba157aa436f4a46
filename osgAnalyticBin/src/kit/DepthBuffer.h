// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Matrixd>

#include <cmath>

namespace osgAnalyticBin {

/// A depth buffer of 24 bits distinguishes depths that differ by this share of its range. These are 16 steps, because
/// drivers interpolate depths in single precision.
inline constexpr double kDepthStep = 0x1p-20;

/// The buffer of a perspective projection stores a + b / z: b, or half of it for projections to depths from 0 to 1.
/// With near and far planes at n and f it is n f / (f - n), above n.
[[nodiscard]] inline double depthScaleOf(const osg::Matrixd& projection) {
    return 0.5 * std::abs(projection(3, 2) / projection(2, 3));
}

}  // namespace osgAnalyticBin

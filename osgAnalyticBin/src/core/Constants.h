// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <limits>

/// Numbers that several files of the core share.
namespace osgAnalyticBin::core {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kHalfPi = 0.5 * kPi;

/// Twice the largest relative error of one rounding.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Plane normals have unit length to within 1e-9 only. Margins that are derived for exact normals are multiplied by
/// this.
inline constexpr double kNormalTolerance = 1.0 + 1e-9;

}  // namespace osgAnalyticBin::core

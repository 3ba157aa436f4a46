// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::core {

/// A point whose coordinates are numbers of any kind: double, long double, derivatives, enclosures. What the formula of
/// a mapping returns.
template <class T>
struct Vec3 {
    /// @{
    /// In the order of the axes.
    T x, y, z;
    /// @}
};

}  // namespace osgAnalyticBin::core

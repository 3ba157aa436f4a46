// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

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

/// origin + a u + b v + c w, for fixed vectors and any kind of numbers.
template <class T>
[[nodiscard]] Vec3<T> combined(const glm::dvec3& origin, const T& a, const glm::dvec3& u, const T& b,
                               const glm::dvec3& v, const T& c, const glm::dvec3& w) {
    return {a * u.x + b * v.x + c * w.x + origin.x, a * u.y + b * v.y + c * w.y + origin.y,
            a * u.z + b * v.z + c * w.z + origin.z};
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

namespace osgAnalyticBin::core {

/// Where a shape stands: an origin and three axes of unit length, at right angles to each other.
struct Frame {
    /// Metres, in the outer frame, as are the axes.
    glm::dvec3 origin{0.0};
    /// First axis.
    glm::dvec3 x{1.0, 0.0, 0.0};
    /// Second axis.
    glm::dvec3 y{0.0, 1.0, 0.0};
    /// Third axis.
    glm::dvec3 z{0.0, 0.0, 1.0};

    /// A point of this frame in the outer one.
    [[nodiscard]] glm::dvec3 toOuter(const glm::dvec3& local) const noexcept {
        return origin + local.x * x + local.y * y + local.z * z;
    }
};

/// The outer frame, seen from a shape: what converts many points to its coordinates.
struct InverseFrame {
    /// Prepares a frame.
    // NOLINTNEXTLINE(google-explicit-constructor): the same frame
    InverseFrame(const Frame& frame) noexcept
        : x(frame.x.x, frame.y.x, frame.z.x),
          y(frame.x.y, frame.y.y, frame.z.y),
          z(frame.x.z, frame.y.z, frame.z.z),
          origin(turned(frame.origin)) {}

    /// A direction of the outer frame, in coordinates of the shape's.
    [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const noexcept { return v.x * x + v.y * y + v.z * z; }

    /// @{
    /// The outer frame's axes, and the place of the shape, along the axes of the shape's frame.
    glm::dvec3 x, y, z, origin;
    /// @}
};

}  // namespace osgAnalyticBin::core

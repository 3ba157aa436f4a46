// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace osgAnalyticBin::core {

/// In one frame, and one unit of length.
using TriangleCorners = std::array<glm::dvec3, 3>;

/// Where the line along `up`, a unit vector, passes a triangle on its way through a point. Triangles that share a side
/// agree on which side of it the line is.
class VerticalPassage final {
public:
    VerticalPassage(const TriangleCorners& triangle, const glm::dvec3& point, const glm::dvec3& up) noexcept
        : _a(triangle[0] - point),
          _b(triangle[1] - point),
          _c(triangle[2] - point),
          _up(up),
          _ab(glm::dot(up, glm::cross(_a, _b))),
          _bc(glm::dot(up, glm::cross(_b, _c))),
          _ca(glm::dot(up, glm::cross(_c, _a))) {}

    /// Whether it passes between the sides.
    [[nodiscard]] bool isWithin() const noexcept {
        return (_ab > 0.0 && _bc > 0.0 && _ca > 0.0) || (_ab < 0.0 && _bc < 0.0 && _ca < 0.0);
    }
    /// The same, or meets a side or a corner. True also for a triangle that holds the line.
    [[nodiscard]] bool isWithinOrOnSide() const noexcept {
        return (_ab >= 0.0 && _bc >= 0.0 && _ca >= 0.0) || (_ab <= 0.0 && _bc <= 0.0 && _ca <= 0.0);
    }
    /// Whether the front face looks up. Requires: isWithin().
    [[nodiscard]] bool facesUp() const noexcept { return _ab > 0.0; }
    /// Of the triangle's plane above the point. NaN for a triangle that holds the line.
    [[nodiscard]] double height() const noexcept {
        return (_ab * glm::dot(_up, _c) + _bc * glm::dot(_up, _a) + _ca * glm::dot(_up, _b)) / (_ab + _bc + _ca);
    }

private:
    const glm::dvec3 _a, _b, _c, _up;  // corners, from the point
    const double _ab, _bc, _ca;        // twice the areas between the line and the sides, seen along it
};

}  // namespace osgAnalyticBin::core

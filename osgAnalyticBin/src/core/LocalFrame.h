// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

#include <cmath>

namespace osgAnalyticBin::core {

/// Sine, cosine and the unit vectors of doc/theory/derivation.md, section 2, at a latitude and longitude (radians).
struct LocalFrame {
    LocalFrame(double latitude, double longitude) noexcept
        : sinLat(std::sin(latitude)),
          cosLat(std::cos(latitude)),
          radial(std::cos(longitude), std::sin(longitude), 0.0),
          east(-radial.y, radial.x, 0.0),
          north(-sinLat * radial.x, -sinLat * radial.y, cosLat),
          up(cosLat * radial.x, cosLat * radial.y, sinLat) {}

    double sinLat, cosLat;
    glm::dvec3 radial, east, north, up;
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace osgAnalyticBin::paper {

/// A kind of view: cameras are drawn at random within its limits.
struct ViewKind {
    const char* name;
    double fovDeg;
    double lowest, highest;     // metres above the ground
    double pitchFrom, pitchTo;  // degrees below the horizontal
};

/// The axes of a camera, in ECEF.
struct CameraAxes {
    glm::dvec3 forward, right, up;
};

/// Looks along an azimuth, clockwise from north, so much above the horizontal; radians.
[[nodiscard]] inline CameraAxes cameraAxes(const core::Geodetic& position, double azimuth, double pitch) noexcept {
    const glm::dvec3 radial(std::cos(position.longitude), std::sin(position.longitude), 0.0);
    const glm::dvec3 axis(0.0, 0.0, 1.0);
    const glm::dvec3 east = glm::cross(axis, radial);
    const glm::dvec3 north = std::cos(position.latitude) * axis - std::sin(position.latitude) * radial;
    const glm::dvec3 zenith = std::cos(position.latitude) * radial + std::sin(position.latitude) * axis;
    const glm::dvec3 level = std::sin(azimuth) * east + std::cos(azimuth) * north;
    const glm::dvec3 forward = std::cos(pitch) * level + std::sin(pitch) * zenith;
    const glm::dvec3 right = glm::normalize(glm::cross(level, zenith));
    return {forward, right, glm::cross(right, forward)};
}

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Terrain.h"

#include <osgAnalyticBin/core/Plane.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::paper {

/// A perspective camera, 4 : 3, in ECEF. Its frustum has four sides and neither near nor far plane.
struct Camera {
    static constexpr double kAspect = 4.0 / 3.0;

    glm::dvec3 eye{0.0};
    glm::dvec3 forward{1.0, 0.0, 0.0}, right{0.0, -1.0, 0.0}, up{0.0, 0.0, 1.0};
    double fovDeg = 60.0;  // from the lower to the upper edge

    /// Left, right, bottom, top.
    [[nodiscard]] std::array<core::Plane, 4> planes() const noexcept;
};

/// A kind of view: cameras are drawn at random within its limits.
struct ViewKind {
    const char* name;
    double fovDeg;
    double lowest, highest;     // metres above the ground
    double pitchFrom, pitchTo;  // degrees below the horizontal
};

inline constexpr std::array<ViewKind, 6> kViewKinds{{{"low, fov 60", 60.0, 2e2, 5e3, -5.0, 10.0},
                                                     {"low, fov 10", 10.0, 2e2, 5e3, -2.0, 5.0},
                                                     {"oblique, fov 60", 60.0, 1e4, 5e5, 15.0, 60.0},
                                                     {"oblique, fov 10", 10.0, 1e4, 5e5, 15.0, 60.0},
                                                     {"high, fov 60", 60.0, 1e6, 1e7, 60.0, 90.0},
                                                     {"high, fov 10", 10.0, 1e6, 1e7, 60.0, 90.0}}};

/// The camera of that number of a kind: above the raster's extent, the same in every run.
[[nodiscard]] Camera randomCamera(Terrain& terrain, std::size_t kind, std::size_t number);

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>

#include <cmath>

namespace osgbindem {

/// Unit vectors in ECEF at a position.
struct TileFrame {
    explicit TileFrame(const osgAnalyticBin::core::Geodetic& position) noexcept {
        const double sp = std::sin(position.latitude);
        const double cp = std::cos(position.latitude);
        const double sl = std::sin(position.longitude);
        const double cl = std::cos(position.longitude);
        up = {cp * cl, cp * sl, sp};
        north = {-sp * cl, -sp * sl, cp};
    }

    glm::dvec3 up;
    glm::dvec3 north;
};

}  // namespace osgbindem

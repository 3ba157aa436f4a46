// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Matrixd>
#include <osg/Plane>

#include <cstdint>
#include <vector>

namespace osgAnalyticBin::assembly {

struct Camera {
    osg::Matrixd modelView;
    osg::Matrixd projection;

    /// The four sides of its frustum; positive distances are inside.
    [[nodiscard]] std::vector<osg::Plane> sidePlanes() const;
};

/// Cameras in and above the plant that look at its parts, with fields of view of 10 to 50 degrees, up and down.
[[nodiscard]] std::vector<Camera> randomCameras(std::size_t count, double halfExtent, std::uint32_t seed);

}  // namespace osgAnalyticBin::assembly

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Assembly.h"

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

/// Who decides about a part.
enum class Culling { Spheres, Bins, SpheresThenBins };

/// What a method kept over all cameras.
struct CullFigures {
    std::size_t kept = 0;           ///< parts that the cull traversal entered
    std::size_t drawn = 0;          ///< parts whose geometry also passed OSG's box test
    std::size_t falselyCulled = 0;  ///< parts not entered, or not drawn, though a sample is in view
    double milliseconds = 0.0;      ///< of one cull traversal, mean
};

/// For each camera, the parts with a sample of the mesh in view.
using Visibility = std::vector<std::vector<bool>>;

[[nodiscard]] Visibility visibleParts(const Assembly& assembly, const std::vector<Camera>& cameras);

/// Culls the assembly from every camera with OSG's own CullVisitor, without a window. Changes the parts' callbacks.
[[nodiscard]] CullFigures cullAssembly(const Assembly& assembly, const std::vector<Camera>& cameras,
                                       const Visibility& visible, Culling culling);

}  // namespace osgAnalyticBin::assembly

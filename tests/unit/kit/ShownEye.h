// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What horizon a camera gets over what is shown: asked for in a real cull traversal, and measured from outside.

#pragma once

#include "CullFixture.h"

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/vec3.hpp>
#include <osg/Group>

#include <limits>
#include <optional>

namespace osgAnalyticBin::test {

/// A camera with a square picture.
struct Picture {
    glm::dvec3 eye{0.0}, forward{0.0}, right{0.0}, up{0.0};
    double fov = 40.0;  // degrees

    Picture(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& roll, double degrees);

    [[nodiscard]] CullView view() const;

    /// Coordinates of the picture run from -1 to 1.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const;
};

/// The eye above what is shown.
struct ShownEye {
    std::optional<core::HorizonEye> eye;
    double found = 0.0;  // depth of the lowest surface
};

inline constexpr double kUndeclared = std::numeric_limits<double>::infinity();

/// Asks for the eye in a cull traversal of the database: a search that starts at `startDepth`, where the terrain is
/// declared to be no deeper than `deepest`.
[[nodiscard]] ShownEye askForEye(osg::Group& database, const Picture& picture, double startDepth = 0.0,
                                 double deepest = kUndeclared);

/// Whether a point is hidden from the eye.
[[nodiscard]] bool hidesPoint(const core::HorizonEye& eye, const glm::dvec3& point);

/// The depth of the occluder that an eye was made for, by where it begins to hide points of the ellipsoid.
[[nodiscard]] double occluderDepth(const core::HorizonEye& eye, const glm::dvec3& from);

/// Where the ray enters the occluder, in metres from the eye.
[[nodiscard]] std::optional<double> entryIntoOccluder(const glm::dvec3& eye, const glm::dvec3& ray, double depth);

/// Scaled so that the ellipsoid is the unit sphere.
[[nodiscard]] glm::dvec3 inUnitSpace(const glm::dvec3& ecef);

}  // namespace osgAnalyticBin::test

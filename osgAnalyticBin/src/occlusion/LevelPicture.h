// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>
#include <osg/CullStack>

#include <array>
#include <optional>

namespace osgAnalyticBin {

/// The lines of sight of a perspective camera that looks more or less level. Directions in ECEF.
struct LevelView {
    glm::dvec3 up, forward;             ///< the eye's vertical, and where the camera looks, level; unit vectors
    std::array<glm::dvec3, 4> corners;  ///< from the eye, at depth 1 in eye space
    double pixels;                      ///< the shorter side of the viewport, in lengths of a pixel's longer side
    /// A depth buffer distinguishes two depths in eye space if their reciprocals differ by more than this.
    double depthStep;

    /// `leastNear`: where OSG computes the near plane later, no more than its depth is. Returns: nullopt for cameras
    /// that look up or down by more than 78 degrees, and those without a viewport.
    [[nodiscard]] OSGANALYTICBIN_EXPORT static std::optional<LevelView> of(osg::CullStack& cullStack,
                                                                           const core::Ellipsoid& ellipsoid,
                                                                           const glm::dvec3& eye,
                                                                           std::optional<double> leastNear);

    /// The axes of a picture of this view, with its eye at `place`.
    [[nodiscard]] OSGANALYTICBIN_EXPORT core::Frame frameAt(const glm::dvec3& place) const;
};

/// What a view shows of the picture on a vertical plane: x = right / forward.
struct PictureSpan {
    core::Interval across;
    /// By how much drivers may draw corners of triangles elsewhere: they snap them to 1/256 of a pixel, both of the
    /// tile that hides and of the hidden one. Where the view is not level, pixels are larger in this picture.
    double drawing;
    /// 1/m: a depth buffer distinguishes two points on a line of sight if their 1 / forward differs by more than this.
    double depthStep;

    /// Returns: nullopt where a corner of the view is more than 78 degrees off the picture's forward direction.
    [[nodiscard]] OSGANALYTICBIN_EXPORT static std::optional<PictureSpan> of(const LevelView& view,
                                                                             const core::Frame& frame);
};

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/CullStack>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/Vec3d>

#include <optional>

namespace osgAnalyticBin {

/// Whether the projection stays as it is when all is culled: OSG computes no near and far planes.
[[nodiscard]] bool isFinalProjection(const osg::CullStack& cullStack);

/// Whether the near and far planes of a projection are tilted against the view direction. OSG moves such planes when it
/// computes them, and leaves them tilted.
[[nodiscard]] bool hasTiltedPlanes(const osg::Matrixd& projection) noexcept;

/// The line of sight (x, y, 1) z through a corner of the picture of a perspective projection, in eye space. Corners: 0
/// to 3. Not finite for projections without a picture.
[[nodiscard]] osg::Vec3d sightThroughCorner(const osg::Matrixd& projection, int corner);

/// Where a cull visitor looks from, in the frame of its current planes: what horizons are made for.
class OSGANALYTICBIN_EXPORT Viewpoint final {
public:
    /// Returns: nullopt for projections that have no horizon, and where the camera is known to have no depth buffer of
    /// 24 bits; unless `inShadowPasses`, also for cameras that inherit their view point or draw depth alone: what casts
    /// a shadow may lie behind it.
    [[nodiscard]] static std::optional<Viewpoint> of(osg::CullStack& cullStack, osg::NodeVisitor& visitor,
                                                     bool inShadowPasses);

    /// See core::HorizonEye; depth in metres below the ellipsoid. Nothing is hidden when the near plane may reach the
    /// occluder, nor when that of an orthographic camera reaches the ellipsoid.
    [[nodiscard]] std::optional<core::HorizonEye> above(const core::Ellipsoid& ellipsoid, double depth) const noexcept;

    /// The largest distance of the near plane from the eye of a perspective camera, in the unit of the planes' frame.
    /// Infinite in doubt, and where OSG computes another near plane after the cull traversal.
    [[nodiscard]] double nearReach() const noexcept;

    /// The eye. Returns: nullptr for orthographic cameras.
    [[nodiscard]] const glm::dvec3* eye() const noexcept { return _isDirection ? nullptr : &_point; }

private:
    bool _isDirection = false;
    double _nearReach = 0.0;  // metres from the eye that the near plane is at most; 0: not known before all is culled
    glm::dvec3 _point{0.0};   // the eye, or a point of the near plane
    glm::dvec3 _direction{0.0};  // of an orthographic camera
};

}  // namespace osgAnalyticBin

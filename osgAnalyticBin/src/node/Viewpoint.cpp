// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Viewpoint.h"

#include "GlmBridge.h"

#include <osg/Camera>
#include <osgUtil/CullVisitor>

namespace osgAnalyticBin {

namespace {

bool inheritsViewpoint(osg::NodeVisitor& visitor) {
    osgUtil::CullVisitor* cullVisitor = visitor.asCullVisitor();
    const osg::Camera* camera =
        cullVisitor && cullVisitor->getRenderStage() ? cullVisitor->getCurrentCamera() : nullptr;
    return camera && camera->getReferenceFrame() == osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT;
}

// Projections whose lines of sight meet in the origin of eye space.
bool isPerspective(const osg::Matrixd& p) {
    return p(2, 3) != 0.0 && p(0, 3) == 0.0 && p(1, 3) == 0.0 && p(3, 3) == 0.0 && p(3, 0) == 0.0 && p(3, 1) == 0.0;
}

// Projections whose lines of sight are parallel.
bool isOrthographic(const osg::Matrixd& p) {
    return p(0, 3) == 0.0 && p(1, 3) == 0.0 && p(2, 3) == 0.0 && p(3, 3) != 0.0;
}

}  // namespace

std::optional<Viewpoint> Viewpoint::of(osg::CullStack& cullStack, osg::NodeVisitor& visitor, bool evenInherited) {
    if (!evenInherited && inheritsViewpoint(visitor)) return std::nullopt;
    osg::Matrixd eyeToWorld;
    if (!eyeToWorld.invert(*cullStack.getModelViewMatrix())) return std::nullopt;
    const osg::Matrixd& projection = *cullStack.getProjectionMatrix();
    Viewpoint viewpoint;
    if (isPerspective(projection)) {
        // in double precision; the cull stack's own eye point is float
        viewpoint._point = toGlm(osg::Vec3d() * eyeToWorld);
        return viewpoint;
    }
    osg::Matrixd unproject;
    if (!isOrthographic(projection) || !unproject.invert(projection)) return std::nullopt;
    const osg::Vec3d nearPoint = osg::Vec3d(0.0, 0.0, -1.0) * unproject;
    const osg::Vec3d direction = osg::Vec3d(0.0, 0.0, 1.0) * unproject - nearPoint;
    viewpoint._isDirection = true;
    viewpoint._point = toGlm(nearPoint * eyeToWorld);
    viewpoint._direction = toGlm(osg::Matrixd::transform3x3(direction, eyeToWorld));
    return viewpoint;
}

std::optional<core::HorizonEye> Viewpoint::above(const core::Ellipsoid& ellipsoid, double depth) const noexcept {
    if (_isDirection) return core::HorizonEye::fromDirection(ellipsoid, depth, _direction, _point);
    return core::HorizonEye::fromEye(ellipsoid, depth, _point);
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTraversal.h"

#include "GlmBridge.h"

#include <osg/Camera>
#include <osg/UserDataContainer>
#include <osgUtil/CullVisitor>

#include <algorithm>

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

std::optional<core::HorizonEye> orthographicEye(const osg::Matrixd& projection, const osg::Matrixd& eyeToEcef,
                                                const Occluder& occluder) {
    osg::Matrixd unproject;
    if (!unproject.invert(projection)) return std::nullopt;
    const osg::Vec3d nearPoint = osg::Vec3d(0.0, 0.0, -1.0) * unproject;
    const osg::Vec3d direction = osg::Vec3d(0.0, 0.0, 1.0) * unproject - nearPoint;
    return core::HorizonEye::fromDirection(occluder.ellipsoid, occluder.depth,
                                           toGlm(osg::Matrixd::transform3x3(direction, eyeToEcef)),
                                           toGlm(nearPoint * eyeToEcef));
}

std::optional<core::HorizonEye> eyeOf(osg::CullStack& cullStack, osg::NodeVisitor& visitor, const Occluder& occluder) {
    if (!occluder.forInheritedViewpoints && inheritsViewpoint(visitor)) return std::nullopt;
    osg::Matrixd eyeToEcef;
    if (!eyeToEcef.invert(*cullStack.getModelViewMatrix())) return std::nullopt;
    const osg::Matrixd& projection = *cullStack.getProjectionMatrix();
    if (isPerspective(projection)) {
        // in double precision; the cull stack's own eye point is float
        const osg::Vec3d eye = osg::Vec3d() * eyeToEcef;
        return core::HorizonEye::fromEye(occluder.ellipsoid, occluder.depth, toGlm(eye));
    }
    return isOrthographic(projection) ? orthographicEye(projection, eyeToEcef, occluder) : std::nullopt;
}

}  // namespace

CullTraversal& CullTraversal::of(osg::NodeVisitor& visitor) {
    // Statistics of a visitor are never anything else.
    return static_cast<CullTraversal&>(BinStatistics::of(visitor));
}

bool CullTraversal::holds(const osg::Polytope::PlaneList& list) const {
    if (list.size() != _planeCount || _planeCount == 0 || _planeCount > kCachedPlanes) return false;
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (unsigned int k = 0; k < 4; ++k) {
            if (list[i][k] != _coefficients[4 * i + k]) return false;
        }
    }
    return true;
}

const core::PlaneSet& CullTraversal::planes(const osg::Polytope& frustum) {
    const osg::Polytope::PlaneList& list = frustum.getPlaneList();
    if (holds(list)) return _planes;
    _planes = core::PlaneSet();
    _planeCount = std::min(list.size(), core::kMaxPlanes);
    for (std::size_t i = 0; i < _planeCount; ++i) _planes.push_back(toCore(list[i]));
    for (std::size_t i = 0; i < std::min(_planeCount, kCachedPlanes); ++i) {
        for (unsigned int k = 0; k < 4; ++k) _coefficients[4 * i + k] = list[i][k];
    }
    _eyeEllipsoid.reset();
    return _planes;
}

const core::HorizonEye* CullTraversal::horizonEye(osg::CullStack& cullStack, osg::NodeVisitor& visitor,
                                                  const Occluder& occluder) {
    const osg::RefMatrix* modelView = cullStack.getModelViewMatrix();
    const bool same = _eyeEllipsoid == occluder.ellipsoid && modelView == _modelView &&
                      visitor.getTraversalNumber() == _eyeFrame && occluder.depth == _eyeDepth;
    if (!same) {
        _eye = eyeOf(cullStack, visitor, occluder);
        _modelView = modelView;
        _eyeFrame = visitor.getTraversalNumber();
        _eyeDepth = occluder.depth;
        _eyeEllipsoid = occluder.ellipsoid;
    }
    return _eye ? &*_eye : nullptr;
}

}  // namespace osgAnalyticBin

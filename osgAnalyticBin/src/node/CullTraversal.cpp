// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTraversal.h"

#include "GlmBridge.h"
#include "Viewpoint.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace osgAnalyticBin {

namespace {

bool isSame(const osg::Matrixd& a, const osg::Matrixd& b) {
    return std::memcmp(a.ptr(), b.ptr(), 16 * sizeof(double)) == 0;
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
    const osg::RefMatrix* projection = cullStack.getProjectionMatrix();
    // Side planes do not tell orthographic cameras apart that differ in the near plane, nor do addresses, which are
    // used again.
    const bool same = _eyeEllipsoid == occluder.ellipsoid && modelView == _modelView && projection == _projection &&
                      visitor.getTraversalNumber() == _eyeFrame && occluder.depth == _eyeDepth &&
                      isSame(*modelView, _eyeModelView) && isSame(*projection, _eyeProjection);
    if (!same) {
        const auto viewpoint = Viewpoint::of(cullStack, visitor, occluder.forInheritedViewpoints);
        _eye = viewpoint ? viewpoint->above(occluder.ellipsoid, occluder.depth) : std::nullopt;
        _modelView = modelView;
        _projection = projection;
        _eyeModelView = *modelView;
        _eyeProjection = *projection;
        _eyeFrame = visitor.getTraversalNumber();
        _eyeDepth = occluder.depth;
        _eyeEllipsoid = occluder.ellipsoid;
    }
    return _eye ? &*_eye : nullptr;
}

double& CullTraversal::lastDepth(const Database& database) {
    for (auto& [known, depth] : _lastDepths) {
        if (known == &database) return depth;
    }
    constexpr std::size_t kMostDatabases = 64;
    if (_lastDepths.size() >= kMostDatabases) _lastDepths.clear();
    return _lastDepths.emplace_back(&database, 0.0).second;
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTraversal.h"

#include "../GlmBridge.h"
#include "Viewpoint.h"

#include <algorithm>

namespace osgAnalyticBin {

namespace {

// What changes when a matrix is overwritten in place by one with the same side planes.
std::array<double, 3> depthOf(const osg::Matrixd& modelView, const osg::Matrixd& projection) {
    return {modelView(3, 2), projection(2, 2), projection(3, 2)};
}

// The visitor that traverses a database in this thread. Looking it up in the user data of visitors is slower.
struct ScopeOfThread {
    const osg::NodeVisitor* visitor = nullptr;
    CullTraversal* traversal = nullptr;
};
thread_local ScopeOfThread scopeOfThread;

}  // namespace

CullTraversal::DatabaseScope::DatabaseScope(osg::NodeVisitor& visitor, CullTraversal& traversal,
                                            const DatabaseView* view)
    : _traversal(traversal),
      _outerView(traversal._databaseView),
      _wasLeftToOsg(traversal._isLeftToOsg),
      _outerVisitor(scopeOfThread.visitor),
      _outerTraversal(scopeOfThread.traversal) {
    traversal._databaseView = view;
    traversal._isLeftToOsg = !view;
    ++traversal._openSelections;
    scopeOfThread = {&visitor, &traversal};
}

CullTraversal::DatabaseScope::~DatabaseScope() {
    _traversal._databaseView = _outerView;
    _traversal._isLeftToOsg = _wasLeftToOsg;
    --_traversal._openSelections;
    scopeOfThread = {_outerVisitor, _outerTraversal};
}

CullTraversal::CullTraversal(BinStatistics& statistics) : _statistics(statistics) {}

CullTraversal::~CullTraversal() = default;

TileSelection& CullTraversal::selection() {
    if (_selections.size() <= _openSelections) _selections.resize(_openSelections + 1);
    return _selections[_openSelections];
}

CullTraversal& CullTraversal::of(osg::NodeVisitor& visitor) {
    if (scopeOfThread.visitor == &visitor) return *scopeOfThread.traversal;
    BinStatistics& statistics = BinStatistics::of(visitor);
    if (!statistics._traversal) statistics._traversal = new CullTraversal(statistics);
    return static_cast<CullTraversal&>(*statistics._traversal);
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

const core::PlaneSet& CullTraversal::planes(osg::CullStack& cullStack) {
    if (_databaseView && _databaseView->modelView == cullStack.getModelViewMatrix() &&
        _databaseView->projection == cullStack.getProjectionMatrix()) {
        return _databaseView->planes;
    }
    const osg::Polytope::PlaneList& list = cullStack.getCurrentCullingSet().getFrustum().getPlaneList();
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
    // The planes are the same as before; side planes alone do not distinguish near planes, nor eyes along an
    // orthographic view.
    const bool same = _eyeEllipsoid == occluder.ellipsoid && modelView == _modelView && projection == _projection &&
                      visitor.getTraversalNumber() == _eyeFrame && occluder.depth == _eyeDepth &&
                      depthOf(*modelView, *projection) == _eyeSpaceDepth;
    if (!same) {
        const auto viewpoint = Viewpoint::of(cullStack, visitor, occluder.forInheritedViewpoints);
        _eye = viewpoint ? viewpoint->above(occluder.ellipsoid, occluder.depth) : std::nullopt;
        _modelView = modelView;
        _projection = projection;
        _eyeSpaceDepth = depthOf(*modelView, *projection);
        _eyeFrame = visitor.getTraversalNumber();
        _eyeDepth = occluder.depth;
        _eyeEllipsoid = occluder.ellipsoid;
    }
    return _eye ? &*_eye : nullptr;
}

}  // namespace osgAnalyticBin

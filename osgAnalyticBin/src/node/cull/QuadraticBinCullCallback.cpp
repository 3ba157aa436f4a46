// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"

#include <osgAnalyticBin/QuadraticBinCullCallback.h>

namespace osgAnalyticBin {

QuadraticBinCullCallback::QuadraticBinCullCallback(const core::QuadraticBin& bin, const osg::BoundingSphere& sphere)
    : _bin(bin), _sphere(sphere) {}

QuadraticBinCullCallback::QuadraticBinCullCallback(const QuadraticBinCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _bin(other._bin),
      _sphere(other._sphere) {}

QuadraticBinCullCallback::~QuadraticBinCullCallback() = default;

void QuadraticBinCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    cullOrTraverse(
        *nv, [&](osg::CullStack& cullStack) { return isCulled(cullStack, *nv); }, [&] { traverse(node, nv); });
}

bool QuadraticBinCullCallback::isCulled(osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (!_bin) return false;
    CullTraversal& traversal = CullTraversal::of(nv);
    return isCulledByBin(cullStack, nv, traversal, _sphere, [&](const osg::Polytope&, core::PlaneMask& undecided) {
        const core::PlaneSet& planes = traversal.planes(cullStack);
        return Verdict{core::classify(*_bin, planes, undecided), Verdict::Plane};
    });
}

}  // namespace osgAnalyticBin

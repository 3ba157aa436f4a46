// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/GlmBridge.h"
#include "../kit/SmallFeature.h"
#include "../kit/cull/CullScopes.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/mappings/QuadraticBinCullCallback.h>

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
    core::Side side = core::Side::Straddling;
    const auto test = [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
        core::PlaneSet planes;
        for (const osg::Plane& plane : frustum.getPlaneList()) planes.push_back(toCore(plane));
        return side = core::classify(*_bin, planes, undecided);
    };
    const bool culled = isOutside(cullStack, test) || isSmall(cullStack.getCurrentCullingSet(), _sphere);
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        BinStatistics::of(nv).count(culled ? core::Side::Outside : side, nv.getTraversalNumber());
    }
    return culled;
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"
#include "GlmBridge.h"

#include <osgAnalyticBin/QuadraticBinCullCallback.h>

namespace osgAnalyticBin {

namespace {

// The planes of a frustum, converted as they are asked for.
struct LocalPlanes {
    const osg::Polytope::PlaneList& planes;

    [[nodiscard]] core::Plane operator[](std::size_t i) const { return toCore(planes[i]); }
};

}  // namespace

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
    osg::CullStack* cullStack = nv->asCullStack();
    if (!cullStack) {
        traverse(node, nv);
        return;
    }
    if (isCulled(*cullStack, *nv)) return;
    const OccluderScope occluders(*cullStack);
    traverse(node, nv);
}

bool QuadraticBinCullCallback::isCulled(osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (!_bin) return false;
    return isCulledByBin(cullStack, nv, _sphere, [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
        const LocalPlanes planes{frustum.getPlaneList()};
        return core::classify(*_bin, planes, planes.planes.size(), undecided);
    });
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxCullCallback.h"

#include "../CallbackChain.h"
#include "../cull/BinCulling.h"

#include <cstdint>

namespace osgAnalyticBin {

namespace {

// The visitor that traverses a set in this thread. Looking it up in the user data of visitors is slower.
struct TraversalOfThread {
    const osg::NodeVisitor* visitor = nullptr;
    CullTraversal* traversal = nullptr;
    BinCounts counts;
};
thread_local TraversalOfThread traversalOfThread;

}  // namespace

CullTraversal& boxTraversalOf(osg::NodeVisitor& visitor) {
    return traversalOfThread.visitor == &visitor ? *traversalOfThread.traversal : CullTraversal::of(visitor);
}

void countBoxes(osg::NodeVisitor& visitor, const BinCounts& counts) {
    if (visitor.getVisitorType() != osg::NodeVisitor::CULL_VISITOR) return;
    if (traversalOfThread.visitor != &visitor) {
        BinCounts ofFrame = counts;
        ofFrame.frame = visitor.getTraversalNumber();
        return BinStatistics::of(visitor).add(ofFrame);
    }
    traversalOfThread.counts.outside += counts.outside;
    traversalOfThread.counts.inside += counts.inside;
    traversalOfThread.counts.straddling += counts.straddling;
}

BoxCullCallback::BoxCullCallback(const BoxCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _set(other._set),
      _tile(other._tile),
      _wasCullingActive(other._wasCullingActive) {}

void BoxCullCallback::place(osg::LOD& node, BoxSet& set, BoxTile& tile) {
    const osg::ref_ptr<BoxCullCallback> callback = new BoxCullCallback(&set, &tile);
    callback->_wasCullingActive = node.getCullingActive();
    callback->setNestedCallback(node.getCullCallback());
    node.setCullCallback(callback);
    node.setCullingActive(false);
}

void BoxCullCallback::remove(osg::LOD& node) {
    const osg::ref_ptr<BoxCullCallback> callback = findCallback<BoxCullCallback>(node.getCullCallback());
    if (!callback) return;
    takeOff(node, *callback);
    node.setCullingActive(callback->_wasCullingActive);
}

void BoxCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    cullOrTraverse(
        *nv, [&](osg::CullStack& cullStack) { return isCulled(*node, cullStack, *nv); }, [&] { traverse(node, nv); });
}

bool BoxCullCallback::isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const {
    if (_set->isRemoved() || !_tile->test().isTested) return false;
    const BoxTest& test = _tile->test();
    const osg::BoundingSphere& sphere = test.sphereOf(node);
    return isCulledByBin(cullStack, nv, boxTraversalOf(nv), sphere,
                         [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
                             const core::Side side = test.sideOf(frustum.getPlaneList(), undecided, node);
                             return Verdict{side, Verdict::Plane};
                         });
}

BoxSetCullCallback::BoxSetCullCallback(const BoxSetCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

void BoxSetCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    if (!cullStack) {
        traverse(node, nv);
        return;
    }
    // culled or kept siblings before the set leave a part of the planes behind
    osg::Polytope& frustum = cullStack->getCurrentCullingSet().getFrustum();
    setUndecided(frustum, static_cast<core::PlaneMask>((std::uint64_t{1} << frustum.getPlaneList().size()) - 1));
    const TraversalOfThread outer = traversalOfThread;
    traversalOfThread = {nv, &CullTraversal::of(*nv), {}};
    // OSG's tests of occluders need the spheres that are switched off
    const CullingMaskScope mask(*cullStack, ~osg::CullingSet::Mask{osg::CullingSet::SHADOW_OCCLUSION_CULLING});
    traverse(node, nv);
    const BinCounts counts = traversalOfThread.counts;
    traversalOfThread = outer;
    countBoxes(*nv, counts);
}

BoxSetUpdateCallback::BoxSetUpdateCallback(const BoxSetUpdateCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop), _set(other._set) {}

void BoxSetUpdateCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    _set->update();
    // a set may have very many tiles, and nothing to update below them
    if (getNestedCallback() || node->getNumChildrenRequiringUpdateTraversal() > 0) traverse(node, nv);
}

}  // namespace osgAnalyticBin

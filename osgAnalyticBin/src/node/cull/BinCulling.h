// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What every bin's cull callback does around the test of its own bin.

#pragma once

#include "CullTraversal.h"

#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingSphere>
#include <osg/Callback>
#include <osg/CullSettings>
#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/NodeVisitor>
#include <osg/Polytope>

#include <cstddef>

namespace osgUtil {
class CullVisitor;
}

namespace osgAnalyticBin {

/// Where a bin lies, and by which test.
struct Verdict {
    enum Reason { Plane, Horizon, Edge, Terrain };
    core::Side side;
    Reason reason;
};

/// Whether the camera that is culled for has occluders. OSG's tests of spheres are all that is needed then: those of
/// occluders keep masks of what is left to test, which they inherit from node to node.
[[nodiscard]] inline bool hasActiveOccluders(osg::CullStack& cullStack) {
    return (cullStack.getCullingMode() & osg::CullSettings::SHADOW_OCCLUSION_CULLING) &&
           !cullStack.getOccluderList().empty();
}

/// OSG's own small-feature test, and nothing else of CullingSet::isCulled(BoundingSphere).
[[nodiscard]] bool isSmall(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere);

/// OSG's whole test of a sphere against these planes of the current culling set.
[[nodiscard]] bool isSphereCulled(osg::CullingSet& cullingSet, core::PlaneMask undecided,
                                  const osg::BoundingSphere& sphere);

/// Sets the planes that are tested from here on. The result mask is what a child with a sphere test begins with when no
/// plane is left.
inline void setUndecided(osg::Polytope& frustum, core::PlaneMask planes) {
    frustum.getCurrentMask() = planes;
    frustum.setResultMask(planes);
}

/// While it exists, OSG tests only the undecided planes below transforms, too. By itself OSG begins with all
/// planes below each transform and moves them to its frame. `undecided` numbers the planes of the current culling set.
/// Where these are not all planes of the camera, because a transform above has left some out, it does nothing.
class PlanesBelow {
public:
    PlanesBelow(osg::CullStack& cullStack, core::PlaneMask undecided) : _cullStack(cullStack) {
        osg::Polytope& frustum = cullStack.getProjectionCullingStack().back().getFrustum();
        _before = frustum.getCurrentMask();
        const std::size_t planes = cullStack.getCurrentCullingSet().getFrustum().getPlaneList().size();
        if (frustum.getPlaneList().size() == planes) frustum.getCurrentMask() &= undecided;
    }
    ~PlanesBelow() { _cullStack.getProjectionCullingStack().back().getFrustum().getCurrentMask() = _before; }
    PlanesBelow(const PlanesBelow&) = delete;
    PlanesBelow& operator=(const PlanesBelow&) = delete;

private:
    osg::CullStack& _cullStack;
    core::PlaneMask _before;
};

/// While it exists, OSG tests below the present node only what is in `mask`, too.
class CullingMaskScope {
public:
    CullingMaskScope(osg::CullStack& cullStack, osg::CullingSet::Mask mask)
        : _cullStack(cullStack),
          _current(cullStack.getCurrentCullingSet().getCullingMask()),
          _projection(cullStack.getProjectionCullingStack().back().getCullingMask()) {
        set(_current & mask, _projection & mask);
    }
    // the stacks may have moved meanwhile
    ~CullingMaskScope() { set(_current, _projection); }
    CullingMaskScope(const CullingMaskScope&) = delete;
    CullingMaskScope& operator=(const CullingMaskScope&) = delete;

private:
    // culling sets of transforms below are made from that of the projection
    void set(osg::CullingSet::Mask current, osg::CullingSet::Mask projection) {
        _cullStack.getCurrentCullingSet().setCullingMask(current);
        _cullStack.getProjectionCullingStack().back().setCullingMask(projection);
    }

    osg::CullStack& _cullStack;
    const osg::CullingSet::Mask _current, _projection;
};

/// Enters a node as osgUtil::CullVisitor does it, without its test of the sphere: for nodes that were tested together
/// with their siblings. `callback`: the node's cull callback, or what is nested in that of a bin; null: none. Requires:
/// a visitor of this very type, and a node that it enters by apply(osg::LOD&) or apply(osg::Group&).
void enterWithoutTest(osg::Node& node, osgUtil::CullVisitor& visitor, osg::Callback* callback = nullptr);

/// Whether the database that is traversed is shown in the shape that a bin was fitted to. If it is not, requests a fit
/// to the present shape. Returns: false without a database.
[[nodiscard]] bool isShownIn(const TerrainShape& fitted, const CullTraversal& traversal);

/// Counts a tile that was tested, in cull traversals. `culled`: by its bin or otherwise.
void count(CullTraversal& traversal, const osg::NodeVisitor& nv, const Verdict& verdict, bool culled);

/// Whether a node is culled: by its bin against the undecided planes, or as a small feature. Planes that have the bin
/// inside are cleared from the frustum's masks, so that they are not tested again below the node. The verdict is
/// counted. `classify(const osg::Polytope& frustum, core::PlaneMask& undecided)` tests the bin.
template <class Classify>
[[nodiscard]] bool isCulledByBin(osg::CullStack& cullStack, osg::NodeVisitor& nv, CullTraversal& traversal,
                                 const osg::BoundingSphere& sphere, const Classify& classify) {
    osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
    osg::Polytope& frustum = cullingSet.getFrustum();
    Verdict verdict{core::Side::Straddling, Verdict::Plane};
    if (cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING) {
        core::PlaneMask undecided = frustum.getCurrentMask();
        verdict = classify(frustum, undecided);
        // OSG pops this mask after the subgraph: a plane cleared here stays cleared just there.
        setUndecided(frustum, undecided);
    }
    const bool culled = verdict.side == core::Side::Outside || isSmall(cullingSet, sphere);
    count(traversal, nv, verdict, culled);
    return culled;
}

/// The body of such a callback: `isCulled(osg::CullStack&)` decides in a cull traversal without occluders, `traverse()`
/// goes on.
template <class IsCulled, class Traverse>
void cullOrTraverse(osg::NodeVisitor& nv, const IsCulled& isCulled, const Traverse& traverse) {
    osg::CullStack* cullStack = nv.asCullStack();
    if (!cullStack || hasActiveOccluders(*cullStack)) {
        traverse();
        return;
    }
    osg::Polytope& frustum = cullStack->getCurrentCullingSet().getFrustum();
    const osg::Polytope::ClippingMask before = frustum.getCurrentMask();
    if (!isCulled(*cullStack)) {
        const PlanesBelow planes(*cullStack, cullStack->getCurrentCullingSet().getFrustum().getCurrentMask());
        traverse();
    }
    // not for siblings
    cullStack->getCurrentCullingSet().getFrustum().setResultMask(before);
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What every bin's cull callback does around the test of its own bin.

#pragma once

#include "Occluders.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingSphere>
#include <osg/CullStack>
#include <osg/NodeVisitor>
#include <osg/Polytope>

namespace osgAnalyticBin {

/// OSG's own small-feature test, and nothing else of CullingSet::isCulled(BoundingSphere).
[[nodiscard]] bool isSmall(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere);

/// Whether a node is culled: by its bin against the undecided planes, as a small feature, or behind an occluder. Planes
/// that have the bin inside are cleared from the frustum's mask, and the verdict is counted.
/// `classify(const osg::Polytope& frustum, core::PlaneMask& undecided)` tests the bin and returns its side.
template <class Classify>
[[nodiscard]] bool isCulledByBin(osg::CullStack& cullStack, osg::NodeVisitor& nv, const osg::BoundingSphere& sphere,
                                 const Classify& classify) {
    osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
    osg::Polytope& frustum = cullingSet.getFrustum();
    core::Side side = core::Side::Straddling;
    if (cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING) {
        core::PlaneMask undecided = frustum.getCurrentMask();
        side = classify(frustum, undecided);
        // OSG pops this mask after the subgraph: a plane cleared here stays cleared just there.
        frustum.getCurrentMask() = undecided;
    }
    const bool culled =
        side == core::Side::Outside || isSmall(cullingSet, sphere) || isOccluded(cullStack, nv.getNodePath(), sphere);
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        BinStatistics::of(nv).count(culled ? core::Side::Outside : side, nv.getTraversalNumber());
    }
    return culled;
}

}  // namespace osgAnalyticBin

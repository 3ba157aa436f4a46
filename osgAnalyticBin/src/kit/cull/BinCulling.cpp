// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"

#include "../tile/InstalledDatabase.h"

#include <osgUtil/CullVisitor>

namespace osgAnalyticBin {

bool isSphereCulled(osg::CullingSet& cullingSet, core::PlaneMask& undecided, const osg::BoundingSphere& sphere) {
    osg::Polytope& frustum = cullingSet.getFrustum();
    const core::PlaneMask before = frustum.getCurrentMask();
    setUndecided(frustum, undecided);
    const bool isCulled = cullingSet.isCulled(sphere);
    undecided = frustum.getResultMask();
    setUndecided(frustum, before);
    return isCulled;
}

void enterWithoutTest(osg::Node& node, osgUtil::CullVisitor& visitor, osg::Callback* callback) {
    if (!visitor.validNodeMask(node)) return;
    osg::StateSet* const state = node.getStateSet();
    visitor.pushOntoNodePath(&node);
    if (state) visitor.pushStateSet(state);
    if (callback) {
        callback->run(&node, &visitor);
    } else {
        node.traverse(visitor);
    }
    if (state) visitor.popStateSet();
    visitor.popFromNodePath();
}

bool isShownIn(const TerrainShape& fitted, const CullTraversal& traversal) {
    const DatabaseView* const view = traversal.databaseView();
    if (!view) return false;
    const bool isShown = view->shape == fitted;
    if (!isShown) view->database->requestRefit();
    return isShown;
}

void count(CullTraversal& traversal, const osg::NodeVisitor& nv, const Verdict& verdict, bool culled) {
    if (nv.getVisitorType() != osg::NodeVisitor::CULL_VISITOR) return;
    BinStatistics& statistics = traversal.statistics();
    statistics.count(culled ? core::Side::Outside : verdict.side, nv.getTraversalNumber());
    if (verdict.reason == Verdict::Horizon) statistics.countHidden();
    if (verdict.reason == Verdict::Edge) statistics.countBeyondEdge();
    if (verdict.reason == Verdict::Terrain) statistics.countOccluded();
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What every bin's cull callback does around the test of its own bin.

#pragma once

#include "../SmallFeature.h"
#include "CullScopes.h"
#include "CullTraversal.h"

#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingSphere>
#include <osg/Callback>
#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/NodeVisitor>
#include <osg/Polytope>

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

/// OSG's whole test of a sphere against the undecided planes of the current culling set. Those that have it inside are
/// cleared.
[[nodiscard]] bool isSphereCulled(osg::CullingSet& cullingSet, core::PlaneMask& undecided,
                                  const osg::BoundingSphere& sphere);

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

/// Whether a tile is a small feature, by the sphere about its bin and by OSG's own, which may be larger.
[[nodiscard]] inline bool isSmallTile(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere,
                                      const osg::Node& tile) {
    return isSmall(cullingSet, sphere) && (!tile.getBound().valid() || isSmall(cullingSet, tile.getBound()));
}

/// As isOutside() or isSmallTile(); the verdict is counted.
template <class Classify>
[[nodiscard]] bool isCulledByBin(const osg::Node& tile, osg::CullStack& cullStack, osg::NodeVisitor& nv,
                                 CullTraversal& traversal, const osg::BoundingSphere& sphere,
                                 const Classify& classify) {
    Verdict verdict{core::Side::Straddling, Verdict::Plane};
    const auto test = [&](const osg::Polytope& frustum, core::PlaneMask& undecided) {
        return (verdict = classify(frustum, undecided)).side;
    };
    const bool culled = isOutside(cullStack, test) || isSmallTile(cullStack.getCurrentCullingSet(), sphere, tile);
    count(traversal, nv, verdict, culled);
    return culled;
}

}  // namespace osgAnalyticBin

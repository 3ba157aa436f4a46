// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a cull callback that tests its node by a bin does to OSG's masks. Headers alone: mappings/ includes it, too.

#pragma once

#include "../Classes.h"
#include "../SmallFeature.h"

#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingSphere>
#include <osg/Callback>
#include <osg/ClusterCullingCallback>
#include <osg/CullSettings>
#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/Geode>
#include <osg/Group>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/Polytope>
#include <osg/PositionAttitudeTransform>

#include <cstddef>

namespace osgAnalyticBin {

/// Whether the camera that is culled for has occluders, and they are tested at the present node. OSG's tests of spheres
/// are all that is needed then: those of occluders keep masks of what is left to test, which they inherit from node to
/// node.
[[nodiscard]] inline bool hasActiveOccluders(osg::CullStack& cullStack) {
    return (cullStack.getCullingMode() & osg::CullSettings::SHADOW_OCCLUSION_CULLING) &&
           !cullStack.getOccluderList().empty() &&
           (cullStack.getCurrentCullingSet().getCullingMask() & osg::CullingSet::SHADOW_OCCLUSION_CULLING);
}

/// While it exists, osg::ClusterCullingCallbacks cull nothing in the traversal.
class WithoutClusterCulling {
public:
    explicit WithoutClusterCulling(osg::CullSettings& settings)
        : _settings(settings), _mode(settings.getCullingMode()) {
        set(_mode & ~osg::CullSettings::CLUSTER_CULLING);
    }
    ~WithoutClusterCulling() { set(_mode); }
    WithoutClusterCulling(const WithoutClusterCulling&) = delete;
    WithoutClusterCulling& operator=(const WithoutClusterCulling&) = delete;

private:
    // cameras below have their own modes as before
    void set(osg::CullSettings::CullingMode mode) {
        const auto inherited = _settings.getInheritanceMask();
        _settings.setCullingMode(mode);
        _settings.setInheritanceMask(inherited);
    }

    osg::CullSettings& _settings;
    const osg::CullSettings::CullingMode _mode;
};

/// Whether ClusterCullingCallbacks cull in the traversal.
[[nodiscard]] inline bool cullsClusters(const osg::CullSettings& settings) {
    return (settings.getCullingMode() & osg::CullSettings::CLUSTER_CULLING) != 0;
}

/// Whether a callback culls nothing in the traversal, because it is for clusters, and stands alone.
[[nodiscard]] inline bool isIdle(const osg::Callback& callback, const osg::CullSettings& settings) {
    return isExactly<osg::ClusterCullingCallback>(callback) && !callback.getNestedCallback() &&
           !cullsClusters(settings);
}

/// Sets the planes that are tested from here on. The result mask is what a child with a sphere test begins with when no
/// plane is left.
inline void setUndecided(osg::Polytope& frustum, core::PlaneMask planes) {
    frustum.getCurrentMask() = planes;
    frustum.setResultMask(planes);
}

/// OSG's whole test of a node's sphere against the undecided planes of the current culling set. Those that have it
/// inside are cleared.
[[nodiscard]] inline bool isSphereCulled(osg::CullingSet& cullingSet, core::PlaneMask& undecided,
                                         const osg::Node& node) {
    if (!node.isCullingActive()) return false;
    osg::Polytope& frustum = cullingSet.getFrustum();
    const core::PlaneMask before = frustum.getCurrentMask();
    setUndecided(frustum, undecided);
    const bool isCulled = cullingSet.isCulled(node.getBound());
    undecided = frustum.getResultMask();
    setUndecided(frustum, before);
    return isCulled;
}

/// Whether the sphere of a node is out of view, and osgUtil::CullVisitor tests it before it does anything else with the
/// node. Nodes of other classes may change before that, as osg::AutoTransform does.
[[nodiscard]] inline bool isLeftOutAtOnce(osg::CullingSet& cullingSet, core::PlaneMask undecided,
                                          const osg::Node& node) {
    return isOneOf<osg::MatrixTransform, osg::PositionAttitudeTransform, osg::Group, osg::Geode, osg::LOD>(node) &&
           isSphereCulled(cullingSet, undecided, node);
}

/// While it exists, the visitor asks for no files.
class NoRequests {
public:
    explicit NoRequests(osg::NodeVisitor& visitor) : _visitor(visitor), _handler(visitor.getDatabaseRequestHandler()) {
        _visitor.setDatabaseRequestHandler(nullptr);
    }
    ~NoRequests() { _visitor.setDatabaseRequestHandler(_handler.get()); }
    NoRequests(const NoRequests&) = delete;
    NoRequests& operator=(const NoRequests&) = delete;

private:
    osg::NodeVisitor& _visitor;
    const osg::ref_ptr<osg::NodeVisitor::DatabaseRequestHandler> _handler;
};

/// Whether a tile is a small feature, by the sphere about its bin and by OSG's own, which may be larger.
[[nodiscard]] inline bool isSmallTile(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere,
                                      const osg::Node& tile) {
    return isSmall(cullingSet, sphere) && (!tile.getBound().valid() || isSmall(cullingSet, tile.getBound()));
}

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

/// Whether a node is culled by its bin against the undecided planes. Planes that have the bin inside are cleared from
/// the frustum's masks, so that they are not tested again below the node.
/// `classify(const osg::Polytope& frustum, core::PlaneMask& undecided)` tests the bin; it is called where OSG culls by
/// the frustum.
template <class Classify>
[[nodiscard]] bool isOutside(osg::CullStack& cullStack, const Classify& classify) {
    osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
    osg::Polytope& frustum = cullingSet.getFrustum();
    core::Side side = core::Side::Straddling;
    if (cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING) {
        core::PlaneMask undecided = frustum.getCurrentMask();
        side = classify(frustum, undecided);
        // OSG pops this mask after the subgraph: a plane cleared here stays cleared just there.
        setUndecided(frustum, undecided);
    }
    return side == core::Side::Outside;
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
    // neither for siblings nor for callbacks in front
    setUndecided(cullStack->getCurrentCullingSet().getFrustum(), before);
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Occluders.h"

#include "../Spheres.h"

#include <osg/Camera>
#include <osg/OccluderNode>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

const osg::Camera* innermostCamera(const osg::NodePath& path) {
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
        if (const osg::Camera* camera = (*node)->asCamera()) return camera;
    }
    return nullptr;
}

bool isInside(const osg::Polytope& volume, const osg::BoundingSphere& sphere) {
    const osg::Polytope::PlaneList& planes = volume.getPlaneList();
    return !planes.empty() && std::all_of(planes.begin(), planes.end(),
                                          [&](const osg::Plane& plane) { return plane.intersect(sphere) > 0; });
}

// A hole counts as soon as the sphere is not wholly outside one of its planes.
bool mayBeSeenThrough(const osg::Polytope& hole, const osg::BoundingSphere& sphere) {
    const osg::Polytope::PlaneList& planes = hole.getPlaneList();
    return std::none_of(planes.begin(), planes.end(),
                        [&](const osg::Plane& plane) { return plane.intersect(sphere) < 0; });
}

// OSG drops holes that another occluder covers, be it one of another camera.
bool hasAllHoles(const osg::ShadowVolumeOccluder& occluder) {
    const auto* node = dynamic_cast<const osg::OccluderNode*>(occluder.getNodePath().back());
    return node && node->getOccluder() && node->getOccluder()->getHoleList().size() == occluder.getHoleList().size();
}

// An occluder does not hide what hangs below its own node.
bool isBelow(const osg::NodePath& path, const osg::NodePath& occluder) {
    return occluder.size() <= path.size() && std::equal(occluder.begin(), occluder.end(), path.begin());
}

}  // namespace

// By the camera's settings: the masks of the culling sets are without occluders below a tile.
bool hasActiveOccluders(osg::CullStack& cullStack) {
    return (cullStack.getCullingMode() & osg::CullSettings::SHADOW_OCCLUSION_CULLING) &&
           !cullStack.getOccluderList().empty();
}

bool isOccluded(osg::CullStack& cullStack, const osg::NodePath& path, const osg::BoundingSphere& sphere) {
    if (!hasActiveOccluders(cullStack) || !sphere.valid()) return false;
    // The stack's own list is in eye coordinates and has never been masked.
    const osg::BoundingSphere inEyeFrame = movedSphere(sphere, *cullStack.getModelViewMatrix());
    // Two cameras may have the same projection.
    const osg::Camera* camera = innermostCamera(path);
    for (osg::ShadowVolumeOccluder& occluder : cullStack.getOccluderList()) {
        if (!occluder.matchProjectionMatrix(*cullStack.getProjectionMatrix()) ||
            innermostCamera(occluder.getNodePath()) != camera || isBelow(path, occluder.getNodePath()) ||
            !isInside(occluder.getOccluder(), inEyeFrame) || !hasAllHoles(occluder)) {
            continue;
        }
        const auto& holes = occluder.getHoleList();
        const bool seen = std::any_of(holes.begin(), holes.end(),
                                      [&](const osg::Polytope& hole) { return mayBeSeenThrough(hole, inEyeFrame); });
        if (!seen) return true;
    }
    return false;
}

OccluderScope::OccluderScope(osg::CullStack& cullStack)
    : _cullStack(cullStack), _active(hasActiveOccluders(cullStack)) {
    if (!_active) return;
    // Culling sets of transforms below are made from that of the projection.
    osg::CullingSet& current = _cullStack.getCurrentCullingSet();
    osg::CullingSet& projection = _cullStack.getProjectionCullingStack().back();
    _current = current.getCullingMask();
    _projection = projection.getCullingMask();
    current.setCullingMask(_current & ~osg::CullingSet::SHADOW_OCCLUSION_CULLING);
    projection.setCullingMask(_projection & ~osg::CullingSet::SHADOW_OCCLUSION_CULLING);
}

OccluderScope::~OccluderScope() {
    if (!_active) return;
    // the stacks may have moved meanwhile
    _cullStack.getCurrentCullingSet().setCullingMask(_current);
    _cullStack.getProjectionCullingStack().back().setCullingMask(_projection);
}

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Occluders.h"

#include "Spheres.h"

#include <algorithm>

namespace osgAnalyticBin {

namespace {

bool isActive(osg::CullStack& cullStack) {
    return (cullStack.getCurrentCullingSet().getCullingMask() & osg::CullingSet::SHADOW_OCCLUSION_CULLING) &&
           !cullStack.getOccluderList().empty();
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

// An occluder does not hide what hangs below its own node.
bool isBelow(const osg::NodePath& path, const osg::NodePath& occluder) {
    return occluder.size() <= path.size() && std::equal(occluder.begin(), occluder.end(), path.begin());
}

}  // namespace

bool isOccluded(osg::CullStack& cullStack, const osg::NodePath& path, const osg::BoundingSphere& sphere) {
    if (!isActive(cullStack) || !sphere.valid()) return false;
    // The stack's own list is in eye coordinates and has never been masked.
    const osg::BoundingSphere inEyeFrame = movedSphere(sphere, *cullStack.getModelViewMatrix());
    for (osg::ShadowVolumeOccluder& occluder : cullStack.getOccluderList()) {
        if (!occluder.matchProjectionMatrix(*cullStack.getProjectionMatrix()) ||
            isBelow(path, occluder.getNodePath()) || !isInside(occluder.getOccluder(), inEyeFrame)) {
            continue;
        }
        const auto& holes = occluder.getHoleList();
        const bool seen = std::any_of(holes.begin(), holes.end(),
                                      [&](const osg::Polytope& hole) { return mayBeSeenThrough(hole, inEyeFrame); });
        if (!seen) return true;
    }
    return false;
}

OccluderScope::OccluderScope(osg::CullStack& cullStack) : _cullStack(cullStack), _active(isActive(cullStack)) {
    if (!_active) return;
    for (osg::ShadowVolumeOccluder& occluder : _cullStack.getOccluderList()) {
        _cullStack.disableAndPushOccludersCurrentMask(occluder.getNodePath());
    }
}

OccluderScope::~OccluderScope() {
    if (!_active) return;
    for (osg::ShadowVolumeOccluder& occluder : _cullStack.getOccluderList()) {
        _cullStack.popOccludersCurrentMask(occluder.getNodePath());
    }
}

}  // namespace osgAnalyticBin

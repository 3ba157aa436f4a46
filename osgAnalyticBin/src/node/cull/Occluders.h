// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/Node>

namespace osgAnalyticBin {

/// Whether the camera that is culled for has occluders.
[[nodiscard]] bool hasActiveOccluders(osg::CullStack& cullStack);

/// Whether a sphere in the current frame lies in the shadow of one of the active occluders, holes considered.
/// OSG's own test of a culling set starts from masks that a node without sphere culling inherits from whatever was
/// tested before it, and may then leave planes out; this one tests all planes, and leaves occluders of other cameras
/// alone, which OSG tells apart by their projections.
[[nodiscard]] bool isOccluded(osg::CullStack& cullStack, const osg::NodePath& path, const osg::BoundingSphere& sphere);

/// Takes the occluders out of OSG's hands for the subgraph of a tile, for the same reason.
class OccluderScope {
public:
    explicit OccluderScope(osg::CullStack& cullStack);
    ~OccluderScope();
    OccluderScope(const OccluderScope&) = delete;
    OccluderScope& operator=(const OccluderScope&) = delete;

private:
    osg::CullStack& _cullStack;
    const bool _active;
    osg::CullingSet::Mask _current = 0, _projection = 0;
};

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/CullingSet>

namespace osgAnalyticBin {

/// OSG's own small-feature test, and nothing else of CullingSet::isCulled(BoundingSphere).
[[nodiscard]] inline bool isSmall(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere) {
    const osg::CullingSet::Mask mask = cullingSet.getCullingMask();
    if (!(mask & osg::CullingSet::SMALL_FEATURE_CULLING) || !sphere.valid()) return false;
    cullingSet.setCullingMask(osg::CullingSet::SMALL_FEATURE_CULLING);
    const bool culled = cullingSet.isCulled(sphere);
    cullingSet.setCullingMask(mask);
    return culled;
}

}  // namespace osgAnalyticBin

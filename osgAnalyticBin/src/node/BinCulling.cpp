// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinCulling.h"

namespace osgAnalyticBin {

bool isSmall(osg::CullingSet& cullingSet, const osg::BoundingSphere& sphere) {
    const osg::CullingSet::Mask mask = cullingSet.getCullingMask();
    if (!(mask & osg::CullingSet::SMALL_FEATURE_CULLING) || !sphere.valid()) return false;
    cullingSet.setCullingMask(osg::CullingSet::SMALL_FEATURE_CULLING);
    const bool culled = cullingSet.isCulled(sphere);
    cullingSet.setCullingMask(mask);
    return culled;
}

}  // namespace osgAnalyticBin

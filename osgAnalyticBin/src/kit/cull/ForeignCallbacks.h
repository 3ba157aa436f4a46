// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Classes.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/Export.h>

#include <osg/Callback>
#include <osg/ClusterCullingCallback>
#include <osg/Node>

namespace osgAnalyticBin {

/// Whether a callback leaves its node out while terrain hides it, and does nothing else. Defined with
/// HiddenByTerrainCallback, which is the only one.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool asksForTerrain(const osg::Callback& callback);

/// Whether a cull callback may leave out what is below its node, or draw it otherwise. Requires: one that is not of the
/// kit.
[[nodiscard]] inline bool isForeign(const osg::Callback& callback) {
    return !isExactly<osg::ClusterCullingCallback>(callback) && !traversesAlways(callback);
}

/// Whether a tile has such a callback besides those of the class `Bin`: it may be drawn in front of what is nearer.
template <class Bin>
[[nodiscard]] bool hasForeignCallback(const osg::Node& tile) {
    for (const osg::Callback* at = tile.getCullCallback(); at; at = at->getNestedCallback()) {
        if (!isExactly<Bin>(*at) && isForeign(*at) && !asksForTerrain(*at)) return true;
    }
    return false;
}

}  // namespace osgAnalyticBin

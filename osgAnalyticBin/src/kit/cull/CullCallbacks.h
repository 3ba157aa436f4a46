// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Classes.h"
#include "../tile/EachNode.h"
#include "DrawnState.h"
#include "ForeignCallbacks.h"
#include "TileFamily.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Callback>
#include <osg/Node>
#include <osg/Projection>

namespace osgAnalyticBin {

/// The cull callbacks of a node: the bin's, and whether others may leave out what is below them.
struct CullCallbacks {
    explicit CullCallbacks(const osg::Node& node) : CullCallbacks(node, [](const osg::Callback&) { return false; }) {}

    /// `isHarmless`: knows more callbacks that leave nothing out.
    template <class IsHarmless>
    CullCallbacks(const osg::Node& node, const IsHarmless& isHarmless) {
        // A dynamic_cast across OSG's virtual bases would be most of the search's cost.
        for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
            if (!bin && isExactly<AnalyticBinCullCallback>(*at)) {
                bin = static_cast<const AnalyticBinCullCallback*>(at->asNodeCallback());
            } else if (isExactly<TileFamily>(*at)) {
                family = static_cast<const TileFamily*>(at->asNodeCallback());
            } else if (isExactly<osg::ClusterCullingCallback>(*at)) {
                isForClusters = true;
            } else if (asksForTerrain(*at)) {
                mayLeaveOut = true;
            } else if (!isHarmless(*at) && isForeign(*at)) {
                mayLeaveOut = isUnknown = true;
            }
        }
    }

    const AnalyticBinCullCallback* bin = nullptr;
    const TileFamily* family = nullptr;
    bool mayLeaveOut = false;
    bool isForClusters = false;  ///< one leaves out what is below where cullsClusters()
    bool isUnknown = false;      ///< one that may leave out may also draw otherwise
};

/// Of a node without what is below it: its state, its class, its primitives, its callbacks.
[[nodiscard]] inline DrawnState drawnStateAt(const osg::Node& node, const StateRules& rules) {
    DrawnState drawn = drawnStateByClass(node, rules);
    drawn.obeysDepth = drawn.obeysDepth && drawsFaces(node);
    if (node.getCullCallback()) {
        const CullCallbacks callbacks(node);
        if (callbacks.isUnknown) drawn = {false, false};
        drawn.hides = drawn.hides && !callbacks.mayLeaveOut;
    }
    // these have a view or planes of their own, in which the tile above is not
    const bool hasOwnPicture = node.asCamera() || isExactly<osg::Projection>(node);
    drawn.isCulled = node.getCullingActive() && !hasOwnPicture;
    return drawn;
}

/// Of a node with all that is below it; nothing is below osgTerrain tiles. `hides` is for meshes, all of whose
/// drawables are to hide.
[[nodiscard]] inline DrawnState drawnStateBelow(osg::Node& node, const StateRules& rules) {
    DrawnState drawn;
    forEachNode(node, [&](osg::Node& part) { drawn &= drawnStateAt(part, rules); });
    return drawn;
}

}  // namespace osgAnalyticBin

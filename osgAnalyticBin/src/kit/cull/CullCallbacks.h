// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Classes.h"
#include "../tile/EachNode.h"
#include "DrawnState.h"
#include "TileFamily.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/Declarations.h>

#include <osg/Callback>
#include <osg/ClusterCullingCallback>
#include <osg/Node>

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
            } else if (!isExactly<osg::ClusterCullingCallback>(*at) && !isHarmless(*at) && !traversesAlways(*at)) {
                mayLeaveOut = true;
            }
        }
    }

    const AnalyticBinCullCallback* bin = nullptr;
    const TileFamily* family = nullptr;
    bool mayLeaveOut = false;
};

/// Of a node without what is below it: its state, its class, its callbacks.
[[nodiscard]] inline DrawnState drawnStateAt(const osg::Node& node, const StateRules& rules) {
    const bool mayBeLeftOut = node.getCullCallback() && CullCallbacks(node).mayLeaveOut;
    return mayBeLeftOut ? DrawnState{false, false} : drawnStateByClass(node, rules);
}

/// Of a node with all that is below it; nothing is below osgTerrain tiles. `hides` is for meshes, all of whose
/// drawables are to hide.
[[nodiscard]] inline DrawnState drawnStateBelow(osg::Node& node, const StateRules& rules) {
    DrawnState drawn;
    forEachNode(node, [&](osg::Node& part) { drawn &= drawnStateAt(part, rules); });
    return drawn;
}

}  // namespace osgAnalyticBin

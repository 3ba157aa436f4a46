// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DrawnNode.h"

#include "../tile/MeshCulling.h"
#include "CullCallbacks.h"

namespace osgAnalyticBin {

DrawnState drawnStateAt(const osg::Node& node, const StateRules& rules) {
    const bool mayBeLeftOut = node.getCullCallback() && CullCallbacks(node).mayLeaveOut;
    return mayBeLeftOut ? DrawnState{false, false} : drawnStateByClass(node, rules);
}

DrawnState drawnStateBelow(osg::Node& node, const StateRules& rules) {
    DrawnState drawn;
    forEachNode(node, [&](osg::Node& part) { drawn &= drawnStateAt(part, rules); });
    return drawn;
}

}  // namespace osgAnalyticBin

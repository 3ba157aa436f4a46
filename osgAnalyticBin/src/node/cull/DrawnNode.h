// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DrawnState.h"

namespace osgAnalyticBin {

/// Of a node without what is below it: its state, its class, its callbacks.
[[nodiscard]] DrawnState drawnStateAt(const osg::Node& node, const StateRules& rules);

/// Of a node with all that is below it; nothing is below osgTerrain tiles. `hides` is for meshes, all of whose
/// drawables are to hide.
[[nodiscard]] DrawnState drawnStateBelow(osg::Node& node, const StateRules& rules);

}  // namespace osgAnalyticBin

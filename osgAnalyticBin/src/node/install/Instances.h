// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFrame.h>

#include <osg/Node>

namespace osgAnalyticBin {

/// Whether a tile is drawn in several places of its globe: no bin holds for all of them.
[[nodiscard]] bool isInstanced(const osg::Node& node, const TileFrame& frame);

}  // namespace osgAnalyticBin

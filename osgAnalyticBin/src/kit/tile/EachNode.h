// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <functional>

namespace osgAnalyticBin {

/// Visits all nodes of a subgraph, but nothing below osgTerrain tiles, the same way every time.
void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action);

}  // namespace osgAnalyticBin

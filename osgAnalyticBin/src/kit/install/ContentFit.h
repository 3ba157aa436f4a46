// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/Node>

namespace osgAnalyticBin {

/// Looks whether all tiles from a node upwards hold what stands among its children, or is drawn by the node itself.
/// `sphere`: of the content, in the frame inside the node. `isMerged`: below a database, which expands bins that do not
/// hold it. Otherwise their tiles stay visible.
void fitIntoTilesFrom(const osg::Node& node, osg::Node& content, const osg::BoundingSphere& sphere, bool isMerged);

}  // namespace osgAnalyticBin

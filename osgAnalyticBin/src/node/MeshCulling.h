// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer switches on a tile's own mesh. osgTerrain tiles are treated, never traversed.

#pragma once

#include <osg/Node>

namespace osgAnalyticBin {

/// Switches OSG's sphere test on the mesh's nodes; drawables keep their boxes.
void setSphereCulling(osg::Node& mesh, bool active);

/// Switches all culling off below the node, boxes of drawables included.
void switchAllCullingOff(osg::Node& node);

/// Makes osg::ClusterCullingCallbacks of the mesh cull nothing, or gives back what was taken. What is saved to a file
/// in between is what was there before.
void suspendClusterCulling(osg::Node& mesh);
void resumeClusterCulling(osg::Node& mesh);

/// The same for one node alone.
void suspendClusterCullingOf(osg::Node& node);
void resumeClusterCullingOf(osg::Node& node);

}  // namespace osgAnalyticBin

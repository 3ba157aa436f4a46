// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer switches on a tile's own mesh. osgTerrain tiles are treated, never traversed.

#pragma once

#include <osg/Node>

namespace osgAnalyticBin {

/// Switches OSG's sphere test on the mesh's nodes; drawables keep their boxes.
void setSphereCulling(osg::Node& mesh, bool active);

/// Switches culling off for one node, and remembers with the node that it was on; or gives it back.
void suspendCullingOf(osg::Node& node);
void resumeCullingOf(osg::Node& node);

/// The same for a mesh, boxes of drawables included.
void suspendCulling(osg::Node& mesh);
void resumeCulling(osg::Node& mesh);

/// Makes osg::ClusterCullingCallbacks of the mesh cull nothing, or gives back what was taken. What is saved to a file
/// in between is what was there before.
void suspendClusterCulling(osg::Node& mesh);
void resumeClusterCulling(osg::Node& mesh);

/// The same for one node alone.
void suspendClusterCullingOf(osg::Node& node);
void resumeClusterCullingOf(osg::Node& node);

}  // namespace osgAnalyticBin

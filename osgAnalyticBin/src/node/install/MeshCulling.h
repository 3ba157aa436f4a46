// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer switches on a tile's own mesh. osgTerrain tiles are treated, never traversed.

#pragma once

#include <osg/Node>

#include <functional>

namespace osgAnalyticBin {

/// Visits all nodes of a mesh, but nothing below osgTerrain tiles, the same way every time.
void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action);

/// Likewise, but nothing below nodes for which `entersBelow` returns false.
void forEachNodeWhere(osg::Node& root, std::function<bool(osg::Node&)> entersBelow);

/// Whether a state in the mesh makes the terrain see-through: isPartSeeThrough().
[[nodiscard]] bool isSeeThroughMesh(osg::Node& mesh);

/// Gives a node that shares its user data a copy of its own.
void ownValues(osg::Node& node);

/// Takes the user data off a node when the last value of ours was all that they held.
void forgetEmptyValues(osg::Node& node);

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

/// Whether a callback is an osg::ClusterCullingCallback, suspended or not.
[[nodiscard]] bool isClusterCulling(const osg::Callback& callback);

/// Whether it is one that culls nothing.
[[nodiscard]] bool isSuspendedCluster(const osg::Callback& callback);

/// The same for one node alone.
void suspendClusterCullingOf(osg::Node& node);
void resumeClusterCullingOf(osg::Node& node);

}  // namespace osgAnalyticBin

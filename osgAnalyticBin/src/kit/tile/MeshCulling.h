// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Visits a tile's own mesh, and suspends culling there that bins replace. osgTerrain tiles are included, but not
// traversed.

#pragma once

#include <osg/Node>

#include <functional>

namespace osgAnalyticBin {

/// Visits all nodes of a mesh, but nothing below osgTerrain tiles, the same way every time.
void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action);

/// Gives a node that shares its user data a copy of its own.
void ownValues(osg::Node& node);

/// Removes a node's user data if they are empty without our last value.
void forgetEmptyValues(osg::Node& node);

/// Makes osg::ClusterCullingCallbacks of the mesh cull nothing, or restores them. A scene that is saved meanwhile has
/// the original callbacks.
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

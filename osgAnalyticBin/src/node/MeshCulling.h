// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer switches on a tile's own mesh. osgTerrain tiles are treated, never traversed.

#pragma once

#include <osg/Node>

namespace osgAnalyticBin {

class InstalledTile;

/// Switches OSG's sphere test off on the mesh's nodes; the tile remembers where it was on. Drawables keep their boxes.
void suspendSpheres(osg::Node& mesh, InstalledTile& tile);

/// Switches it on on all of them, where nothing says which had it on: in a scene that was saved with bins.
void resumeSpheres(osg::Node& mesh);

/// Whether a part of the mesh has state that shows what is behind it: isSeeThrough().
[[nodiscard]] bool isSeeThroughMesh(osg::Node& mesh);

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

/// The same for one node alone.
void suspendClusterCullingOf(osg::Node& node);
void resumeClusterCullingOf(osg::Node& node);

}  // namespace osgAnalyticBin

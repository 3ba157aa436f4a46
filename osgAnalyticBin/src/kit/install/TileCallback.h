// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How a bin's cull callback is put on a tile of a scene, and removed again.

#pragma once

#include <osgAnalyticBin/TileFrame.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/ref_ptr>

#include <set>
#include <utility>

namespace osgAnalyticBin {

class AnalyticBinCullCallback;
class Database;
class InstalledTile;

/// Whether a tile is drawn in several places of its globe: no bin holds for all of them. `root`: of the tile's
/// database; null: a CoordinateSystemNode.
[[nodiscard]] bool isInstanced(const osg::Node& node, const TileFrame& frame, const osg::Node* root);

/// Whether OSG draws something of a tile as another Terrain says than the one that the database follows.
[[nodiscard]] bool isOfOtherTerrain(const FoundTile& tile, const Database& database);

/// The record of a tile that has a bin. Returns: nullptr when it has none, or shares that of the tile it is a clone of.
[[nodiscard]] InstalledTile* recordOf(osg::Node& tile);

/// The node that is culled for a tile: its own, or a group above it, which is put there where the tile has just been
/// read (`isNew`) and is not in the scene.
[[nodiscard]] osg::Node& culledNode(const FoundTile& tile, bool isNew);

/// What the bin of `culled`, the tile's culled node, is moved by: the frame that OSG tests it in, to ECEF or to the
/// map.
[[nodiscard]] osg::Matrixd culledFrame(const FoundTile& tile, osg::Node& culled);

/// Puts the callback in front of those of `culled`. From then on the tile notices what is added below it.
void placeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& callback, InstalledTile& record);

/// Nodes whose callback of a bin is nested in an application's. Clones of the node may share the application's
/// callback, and are known as tiles with bins by what is nested in it: it is taken off when all nodes have been
/// visited.
using NestedCallbacks = std::set<std::pair<osg::ref_ptr<osg::Node>, osg::ref_ptr<osg::Callback>>>;

/// Takes all of them off.
void takeOff(NestedCallbacks& nested);

/// Removes callbacks, watches and what came with them from a subgraph, whether or not their nodes are tiles now.
void removeCallbacksBelow(osg::Node& subgraph, NestedCallbacks& nested);

/// Removes all callbacks of bins, and what came with them: expiry times are as they were. A tile without such a
/// callback stays as it is. Callbacks that are nested in others are left to `nested`.
void removeCallbacks(const FoundTile& tile, NestedCallbacks& nested);

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How a bin's cull callback is put on a tile of a scene, and removed again.

#pragma once

#include <osgAnalyticBin/TileFinder.h>

#include <osg/Group>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/ref_ptr>

#include <set>
#include <utility>

namespace osgAnalyticBin {

class AnalyticBinCullCallback;
class Database;
class InstalledTile;

/// A group that the kit puts above a tile to hold the tile's callback. Its class name is that of a plain osg::Group: it
/// is saved as one.
class Carrier final : public osg::Group {
public:
    Carrier() = default;
    Carrier(const Carrier& other, const osg::CopyOp& copyop) : osg::Group(other, copyop) {}
    osg::Object* cloneType() const override { return new Carrier; }
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new Carrier(*this, copyop); }

protected:
    ~Carrier() override = default;
};

/// The carrier above a node. Returns: nullptr when there is none.
[[nodiscard]] Carrier* carrierOf(osg::Node& node);

/// What the callback of a bin on the node keeps. Returns: nullptr without such a callback, and for an application's
/// own.
[[nodiscard]] InstalledTile* installedTileOf(const osg::Node& node);

/// Whether the kit noticed that the mesh of a tile was moved after bins were installed on it.
[[nodiscard]] bool hasMoved(osg::Node& tile);

/// The callback of a bin that an installer made for this very node. Returns: nullptr when there is none.
[[nodiscard]] const AnalyticBinCullCallback* installedBinOf(const osg::Node& node);

/// The node that is culled for a tile: its own, or a group above it, which is put there where the tile has just been
/// read (`isNew`) and is not in the scene.
[[nodiscard]] osg::Node& culledNode(const FoundTile& tile, bool isNew);

/// What the bin of `culled`, the tile's culled node, is moved by: the frame that OSG tests it in, to ECEF or to the
/// map.
[[nodiscard]] osg::Matrixd culledFrame(const FoundTile& tile, osg::Node& culled);

/// Puts the callback in front of those of `culled`. From then on the tile notices what is added below it.
void placeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& callback, Database& database);

/// Removes a cull callback from a node. It keeps its nested callbacks while other nodes have it, too: clones of a scene
/// may share callbacks.
void takeOff(osg::Node& node, osg::Callback& callback);

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

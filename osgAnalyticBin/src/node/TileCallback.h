// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A bin's cull callback on a tile of a scene: where it goes, and how it comes off again.

#pragma once

#include <osgAnalyticBin/TileFinder.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/NodeCallback>

namespace osgAnalyticBin {

/// The node that is culled for a tile: its own, or a group that is put above it.
[[nodiscard]] osg::Node& culledNode(const FoundTile& tile);

/// What the bin of `culled`, the tile's culled node, is moved by: the frame that OSG tests it in, to ECEF or to the
/// map.
[[nodiscard]] osg::Matrixd culledFrame(const FoundTile& tile, osg::Node& culled);

/// Puts the callback in front of those of `culled`, and switches OSG's sphere test off there and on the tile.
void placeCallback(const FoundTile& tile, osg::Node& culled, osg::NodeCallback& callback);

/// Takes off all callbacks of bins, and what came with them: the sphere test is on again, and expiry times are as they
/// were. A tile without such a callback stays as it is.
void removeCallbacks(const FoundTile& tile);

}  // namespace osgAnalyticBin

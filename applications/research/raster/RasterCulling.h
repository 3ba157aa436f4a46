// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/CoordinateSystemNode>
#include <osg/Node>

#include <cstddef>

namespace osgAnalyticBin::bench {

/// How games let terrain hide terrain, for comparison: occluders of least heights are drawn into a small depth buffer,
/// and what is behind is left out. Before each cull traversal the tiles that will be shown are walked, near ones
/// first, by OSG's own tests of spheres, cluster callbacks and ranges. A tile whose box is hidden by what was drawn is
/// left out with all below it, and not requested; the grids of the others are drawn (TileOccluder.h, DepthRaster.h).
/// Nothing is proven: a pixel of the small buffer is covered or not, and visible tiles may be left out.
/// Source: the rule of OpenMW's forks and Urho3D, and of Intel's sample "Software Occlusion Culling".

/// Adds this and the rules of research/rivals to the methods of osgbinbench.
void addPeers();

/// Prepares the tiles of a file on a globe. A tile without a stored bin has no box: it is never hidden.
/// `pageOf`: for a file that is paged below a globe, its ellipsoid; nullptr for a root file. Call it after
/// fillClusterCallbacks(). A file that was prepared before is left as it is. Returns: how many tiles were prepared.
std::size_t prepareRasterTiles(osg::Node& graph, const osg::EllipsoidModel* pageOf);

/// Adds the walk at the beginning of the scene's cull traversals. The root's frame is ECEF. Cameras without perspective
/// hide nothing. Requires: one camera a frame.
void installRaster(osg::Node& root, int width, int height);

/// Of the depth buffer; its height follows from the picture's.
inline constexpr int kRasterWidth = 256;

}  // namespace osgAnalyticBin::bench

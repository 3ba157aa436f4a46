// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Finds terrain that does not hide what is behind it. The horizon must not rely on such terrain.

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

/// Whether what is drawn in this state may show what is behind it: lines or points in place of faces, blending,
/// alpha and stencil tests, stipples, clip planes, front faces left out, no depth test, no depth or not all colours
/// written, and shaders that may do such things: mayAlterSurface(). State that replaces it farther down does not count.
[[nodiscard]] bool isSeeThrough(const osg::StateSet& state);

/// The same for a state on a part of the terrain. Clockwise front faces and a depth range also count here, because the
/// rest of the terrain has others.
[[nodiscard]] bool isPartSeeThrough(const osg::StateSet& state);

/// The same of a terrain tile: of its image layers, by its own and its Terrain's blending policy, and of posts that are
/// not valid.
[[nodiscard]] bool isSeeThrough(const osgTerrain::TerrainTile& tile);

/// Whether a state between the camera and the visitor's present node makes the terrain see-through, or front faces look
/// down because of a state or a mirroring camera. Returns: false for visitors that collect no state.
[[nodiscard]] bool isStateSeeThrough(osg::NodeVisitor& visitor);

/// The share of the depth buffer's range that states between the camera and the visitor's present node leave to the
/// terrain. State that replaces another farther down counts, too. Returns: 1 for visitors that collect no state.
[[nodiscard]] double depthRangeOfState(osg::NodeVisitor& visitor);

/// Whether a node is known to draw all of its children: switches, levels of detail, sequences and classes of others may
/// leave some out.
[[nodiscard]] bool drawsAllChildren(const osg::Node& node);

}  // namespace osgAnalyticBin

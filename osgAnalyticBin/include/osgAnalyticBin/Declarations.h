// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/Callback>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/Program>

namespace osgAnalyticBin {

/// Declares that a cull callback of the application always traverses its nested callback or its node and changes
/// neither state nor masks nor the scale of levels of detail nor near and far planes, by the user value
/// "osgAnalyticBin.traversesAlways" of the callback. A callback without this declaration may leave out terrain; the
/// horizon is not used while such a callback is on a tile in view or above one, the CoordinateSystemNode and its
/// ancestors included. `always` false: takes it back.
OSGANALYTICBIN_EXPORT void setTraversesAlways(osg::Callback& callback, bool always = true);

/// Returns: whether setTraversesAlways() was called for the callback, or it is a plain osg::NodeCallback.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool traversesAlways(const osg::Callback& callback);

/// Declares that shaders draw every triangle of the terrain, all of it, where its vertices are, and nearer or farther
/// as these are; by the user value "osgAnalyticBin.drawsTriangles" of the program. Terrain under any other program
/// hides nothing; CullOptions::plainShaders declares all programs.
OSGANALYTICBIN_EXPORT void setDrawsTriangles(osg::Program& program);
/// Returns: whether setDrawsTriangles() was called for the program.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool drawsTriangles(const osg::Program& program);

/// Declares that a visitor of a class derived from osgUtil::CullVisitor draws what that would draw, and leaves near and
/// far planes to it; by the user value "osgAnalyticBin.drawsAsCullVisitor" of the visitor. Without this declaration
/// nothing is hidden behind terrain where OSG computes these planes.
OSGANALYTICBIN_EXPORT void setDrawsAsCullVisitor(osg::NodeVisitor& visitor);
/// Returns: whether setDrawsAsCullVisitor() was called for the visitor.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool drawsAsCullVisitor(const osg::NodeVisitor& visitor);

/// Declares that the tiles below a node are a photogrammetry set, whose LODs may have spheres that do not hold what is
/// below them; by the user value "osgAnalyticBin.photogrammetrySet" of the node. installBins() then puts no bins there,
/// and lets no LOD be culled whose loaded vertices are in view. Call it before.
OSGANALYTICBIN_EXPORT void markPhotogrammetrySet(osg::Group& set);
/// Returns: whether markPhotogrammetrySet() was called for the node, before or after it was stored in a file.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isPhotogrammetrySet(const osg::Node& node);

}  // namespace osgAnalyticBin

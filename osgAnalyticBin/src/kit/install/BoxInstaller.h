// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Bins of photogrammetry sets: the boxes of what stands below their LODs, in the map whose coordinates are those of the
// files.

#pragma once

#include <osgAnalyticBin/CullOptions.h>

#include <osg/Group>

#include <cstddef>

namespace osgAnalyticBin {

/// Installs bins on all tiles of a set, in place of earlier ones, and on those that are loaded later.
/// Guarantee: a LOD is never culled if a vertex of it, or of what is loaded below, is inside all planes; nor, where the
/// index knows its content, if one of what is not loaded is. Tests: BoxSets.*.
/// Returns: the number of LODs that have bins now.
std::size_t installBoxes(osg::Group& set, const CullOptions& options);

/// Removes them.
void removeBoxes(osg::Group& set);

}  // namespace osgAnalyticBin

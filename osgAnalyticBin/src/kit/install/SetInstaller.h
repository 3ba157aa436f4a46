// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Photogrammetry sets have no bins: OSG culls them. Spheres in their files need not hold what stands below the LODs.
// Such a LOD is culled where its sphere is out of view and so is the box of what is loaded.

#pragma once

#include <osgAnalyticBin/CullOptions.h>

#include <osg/Group>
#include <osg/Node>

#include <cstddef>

namespace osgAnalyticBin {

/// Has all LODs of a set, and those that are loaded later, looked after.
/// Guarantee: a LOD is never culled if a vertex of it, or of what is loaded below, is inside all planes; tests:
/// FalseSpheres.*. LODs below transforms are left to OSG. Returns: the number of LODs; none where no bins are
/// installed.
std::size_t installOnSet(osg::Group& set, const CullOptions& options);

/// Takes watches, and what else was installed on a LOD of a set, off a node.
void removeFromLod(osg::Node& node);

}  // namespace osgAnalyticBin

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Viewpoint.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Horizon.h>

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeVisitor>

#include <optional>

namespace osgAnalyticBin {

/// The eye over a database: the occluder lies just below the lowest surface that the
/// cull traversal about to begin shows, by levels of detail and by what is loaded, in the frustum, between the eye
/// and its horizon.
/// `shape` is the one that the database is shown in. Coarse meshes elsewhere, which dip far below the ellipsoid, do not
/// count. Nothing at all is drawn below `deepest` (metres), infinite where no altitude is declared. `depth` (metres) is
/// where the search starts, best that of the last frame; it returns the depth found. Requires: tiles that cover the
/// globe without gaps, an eye above them. Guarantee: nothing is hidden that is seen past the shown surfaces; the eye's
/// occluder is no deeper than `depth` was or 1.05 times the depth found, but for eyes below the ellipsoid; tests:
/// ShownDepth.*. Returns: nullopt when something of unknown depth is shown and no altitude is declared, or when nothing
/// can be hidden. Cost: one short test for every tile shown on the near side of the horizon. Source: doc/horizon.md,
/// section 8.
[[nodiscard]] std::optional<core::HorizonEye> eyeAboveWhatIsShown(
    osg::Group& database, osg::NodeVisitor& visitor, const osg::CullStack& cullStack, const Viewpoint& viewpoint,
    const core::Ellipsoid& ellipsoid, const TerrainShape& shape, double deepest, double& depth);

}  // namespace osgAnalyticBin

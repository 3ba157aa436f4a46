// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Node>

namespace osgAnalyticBin {

/// The bin of all triangles below a node, chords between vertices included. `localToEcef` is the frame in which the
/// node stands.
/// Returns: an invalid bin when there are no triangles, or when they do not lie about the surface of the ellipsoid as
/// terrain does.
[[nodiscard]] AnalyticBin terrainBounds(osg::Node& node, const osg::EllipsoidModel& ellipsoid,
                                        const osg::Matrixd& localToEcef);

}  // namespace osgAnalyticBin

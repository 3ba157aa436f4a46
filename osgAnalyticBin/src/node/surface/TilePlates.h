// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Node>

#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// Bounds of the altitudes of what a tile draws by itself, skirts folded up. `meshes` stand in a frame that
/// `localToEcef` takes to ECEF.
/// Returns: nullptr where they are not known: for several levels of detail, osgTerrain tiles, what tileSurface() does
/// not know, and meshes at a pole. Cost: a fraction of a millisecond.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::unique_ptr<const core::GroundPlates> tilePlates(
    const std::vector<osg::ref_ptr<osg::Node>>& meshes, const osg::EllipsoidModel& ellipsoid,
    const osg::Matrixd& localToEcef);

/// The rectangle that such meshes fill without holes, up to half a rim of a plate on each side; empty: not known.
[[nodiscard]] core::GeodeticBin rectangleFilledBy(const std::vector<osg::ref_ptr<osg::Node>>& meshes,
                                                  const osg::EllipsoidModel& ellipsoid,
                                                  const osg::Matrixd& localToEcef);

/// Reads the triangles of all parts of a tile's mesh, skirts included, into an empty mesh. Returns: false where they
/// are not known, as above.
[[nodiscard]] bool readTileMesh(osg::Node& node, const osg::Matrixd& localToEcef, core::EcefMesh& mesh);

}  // namespace osgAnalyticBin

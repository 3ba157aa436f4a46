// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Matrixd>
#include <osg/Vec3d>

#include <optional>
#include <string>

namespace osgAnalyticBin::plugin {

/// Where a photogrammetry set stands on the WGS 84 ellipsoid: one affine matrix for all tiles, so that none of their
/// edges opens.
struct SetPlacement {
    osg::Matrixd localToEcef;
    std::string warning;  ///< why it is only roughly so; empty: it is exact
};

/// The place of a set in a reference system that PROJ knows, by the affine mapping that touches the system's own at
/// `center`, in the coordinates of the tiles; `origin` is added to these. Away from there it leaves the curved surface
/// by d^2 / (2 R), 8 cm at 1 km and 8 m at 10 km; convergence and scale are those of the center.
/// Returns: nullopt when the reference system is malformed or unknown; then `error` says why.
[[nodiscard]] std::optional<SetPlacement> projectedPlacement(const std::string& srs, const osg::Vec3d& origin,
                                                             const osg::Vec3d& center, std::string& error);

}  // namespace osgAnalyticBin::plugin

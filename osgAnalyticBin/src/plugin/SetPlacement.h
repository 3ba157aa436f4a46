// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PhotogrammetryMetadata.h"

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

/// ENU: the plane that touches the ellipsoid at its latitude and longitude; exact. Any other reference system, by PROJ:
/// the affine mapping that touches the system's own at `center`, in the coordinates of the tiles. Away from there it
/// leaves the curved surface by d^2 / (2 R), 8 cm at 1 km and 8 m at 10 km; convergence and scale are those of the
/// center. Requires: metadata.srs is not empty.
/// Returns: nullopt when the reference system is malformed or unknown; then `error` says why.
[[nodiscard]] std::optional<SetPlacement> placementOf(const PhotogrammetryMetadata& metadata, const osg::Vec3d& center,
                                                      std::string& error);

/// The part of placementOf() for which PROJ is needed.
[[nodiscard]] std::optional<SetPlacement> projectedPlacementOf(const PhotogrammetryMetadata& metadata,
                                                               const osg::Vec3d& center, std::string& error);

}  // namespace osgAnalyticBin::plugin

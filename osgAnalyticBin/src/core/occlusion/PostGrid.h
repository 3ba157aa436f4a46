// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace osgAnalyticBin::core {

/// Posts that are evenly spaced in latitude and longitude.
struct PostGrid {
    GeodeticGrid grid;
    std::vector<double> altitudes;  ///< metres, row by row from the south-west
    double error = 0.0;             ///< metres by which posts may stand beside their places
    /// Metres, the highest that a skirt reaches for each quarter of the extents; minus infinity where it has none.
    std::array<double, 4> skirtTops{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

/// The grid whose posts are the first vertices of a mesh, row by row from the south-west. The mesh lies within the
/// extents, and fills them.
/// Returns: nullopt unless the mesh has two triangles, front faces up, between every four posts, and no others but
/// skirts, which do not count for any cell of the extents.
/// Cost: some 20 nanoseconds for each vertex and each triangle, 100 for those of skirts.
[[nodiscard]] std::optional<PostGrid> postGridOf(const Ellipsoid& ellipsoid, const EcefMesh& mesh,
                                                 const GeodeticBin& extents);

}  // namespace osgAnalyticBin::core

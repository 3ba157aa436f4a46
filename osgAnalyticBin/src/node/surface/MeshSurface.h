// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "SurfaceMesh.h"

#include <osgAnalyticBin/TileSurface.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

namespace osgAnalyticBin {

/// The surface of one drawable's mesh, whose skirts are folded up. Requires: at least one triangle, indices
/// within the vertices.
[[nodiscard]] TileSurface meshSurface(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid);

}  // namespace osgAnalyticBin

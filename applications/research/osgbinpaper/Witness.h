// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Camera.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <optional>

namespace osgAnalyticBin::paper {

/// A point of a tile that is inside a frustum: the proof that the tile must not be culled.
struct Witness {
    core::Geodetic position;
    double depth = 0.0;  // metres from the nearest side of the frustum
};

/// The position at shares, from 0 to 1, of a bin's latitudes, longitudes and altitudes.
[[nodiscard]] core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept;

/// Looks for the point of the bin that is deepest inside the frustum: a grid of samples, then ever smaller steps from
/// the best.
/// Returns: nullopt when no sample is inside; a thin piece of the bin may have been missed.
[[nodiscard]] std::optional<Witness> findWitness(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                                 const Camera& camera);

/// The same on the terrain itself, and only where the globe does not hide it from the eye.
[[nodiscard]] std::optional<Witness> findTerrainWitness(Terrain& terrain, const core::GeodeticBin& bin,
                                                        const Camera& camera);

}  // namespace osgAnalyticBin::paper

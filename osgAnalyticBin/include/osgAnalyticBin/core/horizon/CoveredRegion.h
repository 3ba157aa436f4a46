// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/vec3.hpp>

namespace osgAnalyticBin::core {

/// The part of the globe that a regional database covers without gaps: all altitudes between two latitudes and two
/// longitudes. Terrain hides what is behind it where lines of sight stay over the region; a line of sight that comes
/// from beside the region may pass below the terrain's border.
/// Source: doc/theory/horizon.md, section 10.
class CoveredRegion final {
public:
    /// The altitudes of `extents` do not matter. Nothing stays over an empty region, nor over one on an ellipsoid with
    /// |e²| above 0.01.
    CoveredRegion(const Ellipsoid& ellipsoid, const GeodeticBin& extents) noexcept;

    /// What the region is a part of.
    [[nodiscard]] const Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    /// Latitudes and longitudes of the region.
    [[nodiscard]] const GeodeticBin& extents() const noexcept { return _extents; }

    /// Whether every position of the bin is over the region.
    [[nodiscard]] bool contains(const GeodeticBin& bin) const noexcept;

    /// Whether every segment from the eye to a point over the region stays over it. Points and eye are at most a tenth
    /// of the smaller radius below the ellipsoid.
    /// Guarantee: true only if it is so; tests: CoveredRegion.HoldsAllSegments.
    /// Cost: a conversion to geodetic coordinates and some ten trigonometric functions.
    [[nodiscard]] bool holdsSegmentsFrom(const glm::dvec3& eyeEcef) const noexcept;

    /// Whether every line of sight that meets the occluder, in any direction, stays over the region until it does.
    /// Never for orthographic cameras. Requires: an eye on the region's ellipsoid.
    /// Guarantee: true only if it is so; tests: CoveredRegion.HoldsTheHorizon*.
    /// Cost: some twenty trigonometric functions.
    [[nodiscard]] bool holdsHorizonOf(const HorizonEye& eye) const noexcept;

private:
    Ellipsoid _ellipsoid;
    GeodeticBin _extents;
};

}  // namespace osgAnalyticBin::core

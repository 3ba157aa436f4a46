// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FrustumHull.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::rivals {

using hull::FrustumHull;

// Boxes around a geodetic bin, as other programs cull by: for comparison, yet sound. Both touch the bin on all six
// sides, to 160 epsilon times the distance of its farthest point from the earth's centre, 0.3 micrometres on earth;
// tests: BoxBins.TouchTheBinOnAllSides. A bin that ExactGeodeticBin does not hold gets a box about the whole globe.

/// The box along the axes of ECEF, as osg::BoundingBox is.
class BoxBin final {
public:
    /// `margin` (metres) is added on all sides: what is drawn may leave the bin by that much.
    /// Requires: the bin is not empty.
    /// Cost: that of an ExactGeodeticBin, and three of its ranges.
    BoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin = 0.0) noexcept;

    /// Guarantee: Outside only if distance(x) < 0, Inside only if >= 0, for every x in the bin and every point within
    /// the margin of it; tests: BoxBins.NeverContradictASample. A plane with NaN is Straddling.
    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

    /// How many faces a box has.
    static constexpr std::size_t kFaces = 6;

    /// Points into the box; holds the bin, margin included.
    [[nodiscard]] core::Plane face(std::size_t i) const noexcept;

    /// No point of the bin, margin included, is farther from the earth's centre.
    [[nodiscard]] double reach() const noexcept { return _reach; }

private:
    glm::dvec3 _center, _halfSize;
    double _slack;  // rounding that does not depend on the plane
    double _reach;
};

/// The box along east, north and up at the bin's middle, as Cesium and osgEarth cull by.
class OrientedBoxBin final {
public:
    /// As BoxBin's.
    OrientedBoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin = 0.0) noexcept;

    /// Guarantee: as BoxBin's.
    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

    /// How many faces a box has.
    static constexpr std::size_t kFaces = 6;

    /// Points into the box; holds the bin, margin included.
    [[nodiscard]] core::Plane face(std::size_t i) const noexcept;

    /// No point of the bin, margin included, is farther from the earth's centre.
    [[nodiscard]] double reach() const noexcept { return _reach; }

private:
    glm::dvec3 _center;                   // ECEF
    std::array<glm::dvec3, 3> _halfAxes;  // the axes times the half size
    double _slack;                        // rounding that does not depend on the plane
    double _reach;
    std::array<glm::dvec3, 3> _axes;  // east, north, up, of unit length
};

/// The usual reverse test: whether the frustum is wholly beyond one face of the box.
/// Guarantee: true only if no point of the bin, margin included, is inside all of the frustum's planes;
/// test: HullSoundness.HasNoFalseVerdict.
/// Cost: up to six faces times eight corners; most faces end at their first corner.
[[nodiscard]] bool isSeparated(const BoxBin& box, const FrustumHull& frustum) noexcept;
/// As that of BoxBin.
[[nodiscard]] bool isSeparated(const OrientedBoxBin& box, const FrustumHull& frustum) noexcept;

}  // namespace osgAnalyticBin::rivals

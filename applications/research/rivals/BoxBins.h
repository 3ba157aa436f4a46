// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::rivals {

/// A box around a geodetic bin, as other programs cull by: for comparison, yet sound. It touches the bin on all six
/// sides, to 160 epsilon times the distance of its farthest point from the earth's centre, 0.3 micrometres on earth;
/// tests: BoxBins.TouchTheBinOnAllSides. A bin that ExactGeodeticBin does not hold gets a box about the whole globe.
/// Requires: the bin is not empty. Cost: that of an ExactGeodeticBin, and three of its ranges.
class Box {
public:
    /// Guarantee: Outside only if distance(x) < 0, Inside only if >= 0, for every x in the bin and every point within
    /// the margin of it; tests: Soundness.HasNoFalseVerdict. A plane with NaN is Straddling.
    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

    /// How many faces a box has.
    [[nodiscard]] static constexpr std::size_t faceCount() noexcept { return 6; }

    /// Points into the box; holds the bin, margin included.
    [[nodiscard]] core::Plane face(std::size_t i) const noexcept;

    /// No point of the bin, margin included, is farther from the earth's centre.
    [[nodiscard]] double reach() const noexcept { return _reach; }

protected:
    using Axes = std::array<glm::dvec3, 3>;

    /// `axes`: ECEF, of unit length. `margin` (metres) is added on all sides: what is drawn may leave the bin by that
    /// much.
    Box(const Axes& axes, const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept;

private:
    Axes _axes;
    Axes _halfAxes;           // the axes times the half size
    glm::dvec3 _center{0.0};  // ECEF
    double _slack = 0.0;      // rounding that does not depend on the plane
    double _reach = 0.0;
};

/// The box along the axes of ECEF, as osg::BoundingBox is.
class BoxBin final : public Box {
public:
    BoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin = 0.0) noexcept;
};

/// The box along east, north and up at the bin's middle, as Cesium and osgEarth cull by.
class OrientedBoxBin final : public Box {
public:
    OrientedBoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin = 0.0) noexcept;
};

}  // namespace osgAnalyticBin::rivals

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

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

/// The rule of [JJ] as published, for comparison only: the second-order model over the box grown by a factor, its
/// range taken over nine points (the eight corners and the stationary point), no remainder.
/// Guarantee: none. It culls visible tiles and accepts invisible ones: osgbinpaper counts them.
class PaperBin final {
public:
    /// Factor of all three half sizes.
    static constexpr double kDefaultGrowth = 1.1;

    /// `growth`: 1 or more. Cost: one evaluation of the mapping and its derivatives.
    PaperBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box,
             double growth = kDefaultGrowth) noexcept;

    /// By the nine points; never a proof.
    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

private:
    core::QuadraticBin _model;
};

/// The test of the eight mapped corners, for comparison only.
/// Guarantee: none; a curved bin bulges past its corners.
class CornersBin final {
public:
    /// Cost: eight evaluations of the mapping.
    CornersBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box) noexcept;

    /// By the eight corners; never a proof.
    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

private:
    std::array<glm::dvec3, 8> _corners;
};

/// One point that replaces a bin, as Cesium's horizon culling point: above the bin's middle in unit space, and so high
/// that the whole bin is hidden if the point is. It hides less than the bin itself. The height depends on the
/// occluder's depth. The object keeps the numbers that determine it: the middle, the angle from there to the bin's
/// farthest direction, and the bin's largest radius. Source: [R13]; doc/theory/horizon.md, section 9.
class HorizonPoint final {
public:
    /// `bin` holds the margin already. A bin more than a quarter turn from its middle is never hidden.
    explicit HorizonPoint(const core::HorizonBin& bin) noexcept;

    /// Guarantee: true only if the bin that the point was made for is hidden; test: Soundness.HasNoFalseVerdict.
    /// Cost: about a dozen multiplications and a square root.
    [[nodiscard]] bool isHiddenFrom(const core::HorizonEye& eye) const noexcept;

private:
    glm::dvec3 _direction{1.0, 0.0, 0.0};       // to the bin's middle, unit length in unit space
    double _cosSpread = 1.0, _sinSpread = 0.0;  // the largest angle from there to a direction of the bin
    double _inverseRadius = 0.0;                // of the farthest point, rounded down; zero: never hidden
};

}  // namespace osgAnalyticBin::rivals

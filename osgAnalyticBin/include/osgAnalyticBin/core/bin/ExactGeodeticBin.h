// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/KernelData.h>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// A geodetic bin by its support function in closed form: the range of the signed distance to a plane without a series
/// and without trigonometry, for any ellipsoid of revolution and bins of any width, poles and date line included.
/// Source: ours; doc/theory/derivation.md, section 8.
/// Requires: holds(ellipsoid, bin) (asserted).
class ExactGeodeticBin final {
public:
    /// True when the bin is not empty and its altitudes are above minus the smallest radius of curvature.
    [[nodiscard]] static bool holds(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept;

    /// `margin` (metres) is added on all sides: what is drawn may leave the bin by that much.
    /// Cost: the sines and cosines of six angles.
    ExactGeodeticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) noexcept;

    /// Makes the bin from its numbers, in the order of row::Exact and `stride` apart. Its reach() is the one of its
    /// sphere.
    explicit ExactGeodeticBin(const double* numbers, std::size_t stride = 1) noexcept;

    /// Guarantee: Outside only if distance(x) < 0, Inside only if >= 0, for every x in the bin and every point within
    /// the margin of it; tests: Soundness.HasNoFalseVerdict. Requires:
    /// plane.normal of unit length to 1e-9. A plane with NaN is Straddling. Cost: four multiplications for most planes
    /// (a sphere), about 35 and at most six square roots beside the bin.
    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

    /// An interval that holds the signed distance of every point of the bin, margin included.
    /// Guarantee: without margin, exceeds the true range on each side by at most 64 epsilon times the sum of the larger
    /// radius, the largest altitude either way and the plane's offset, for bins wider than 1e-14 radians or of no
    /// width; tests: ExactGeodeticBin.IsTightToRounding, Soundness.HasNoFalseVerdictNearTies.
    [[nodiscard]] Interval distanceRange(const Plane& plane) const noexcept;

    /// The largest n.x over the bin, without margin, to 64 epsilon times the larger radius and altitude.
    [[nodiscard]] double support(const glm::dvec3& direction) const noexcept;

    /// A point of the bin, without margin, where n.x is largest, to rounding: where a search continues; not a proof.
    [[nodiscard]] glm::dvec3 supportPoint(const glm::dvec3& direction) const noexcept;

    /// A point of the bin's convex hull, up to rounding. If it is inside two planes, no plane separates the bin from
    /// the wedge inside them.
    [[nodiscard]] glm::dvec3 hullPoint() const noexcept {
        return {_numbers[row::CenterX], _numbers[row::CenterY], _numbers[row::CenterZ]};
    }

    /// No point of the bin, margin included, is farther from the earth's centre.
    [[nodiscard]] double reach() const noexcept { return _farthest; }

    /// What the kernels read: row::Exact.
    [[nodiscard]] const std::array<double, row::ExactEnd>& numbers() const noexcept { return _numbers; }

private:
    void setMeridian(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept;
    void setParallel(const GeodeticBin& bin) noexcept;
    void setSphere(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept;

    std::array<double, row::ExactEnd> _numbers{};
    double _farthest;
};

static_assert(sizeof(ExactGeodeticBin) <= 256, "a database holds one for every tile");

/// Tests the bin against the undecided planes of a set: see classifyNumbers().
[[nodiscard]] inline Side classify(const ExactGeodeticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return classifyNumbers(bin.numbers().data(), true, planes, undecided);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// The mathematics of bins, without OpenSceneGraph.
namespace osgAnalyticBin::core {

/// Where a bin lies with respect to a plane or to a set of planes. Outside and Inside are proofs, truncation and
/// rounding included; Straddling also means "not decided".
enum class Side { Outside, Straddling, Inside };

/// The plane normal.x + offset = 0 with a unit normal that points into the frustum: a positive distance is inside.
/// A plane whose normal is not of unit length to 1e-9, and one with NaN or infinite numbers, decides nothing: every bin
/// straddles it; tests: PlaneSet.PlanesWithoutAUnitNormalDecideNothing.
struct Plane {
    /// Of unit length, pointing inside.
    glm::dvec3 normal{0.0, 0.0, 1.0};
    /// Metres: the distance of the origin.
    double offset = 0.0;

    /// Metres, positive inside.
    [[nodiscard]] double distance(const glm::dvec3& point) const noexcept { return glm::dot(normal, point) + offset; }
};

/// Whether the normal is of unit length to 1e-9, and its own rounding.
[[nodiscard]] inline bool hasUnitNormal(const Plane& plane) noexcept {
    constexpr double kTolerance = 2.000001e-9;  // of the square
    return std::abs(glm::dot(plane.normal, plane.normal) - 1.0) <= kTolerance;
}

/// Whether the plane may decide anything, by its normal. Requires: a unit normal, or one that is not finite (asserted).
[[nodiscard]] inline bool isUsable(const Plane& plane) noexcept {
    const bool isUnit = hasUnitNormal(plane);
    assert(hasUnitNormal(plane) || !std::isfinite(glm::dot(plane.normal, plane.normal)));
    return isUnit;
}

/// One bit a plane; a set bit means that the plane is still undecided.
using PlaneMask = std::uint32_t;

/// As many planes as a mask has bits.
inline constexpr std::size_t kMaxPlanes = 32;

/// Tests a bin (anything with `Side classify(const Plane&) const`) against the undecided planes. `planes` is anything
/// whose planes[i] gives a Plane: an array, or a view that converts on the way.
/// Returns: Outside at the first plane that proves it; Inside when no undecided plane is left; else Straddling. The
/// bits of planes that have the whole bin inside are cleared from `undecided`, also when the result is Outside. Planes
/// above kMaxPlanes are not tested, and nothing is Inside then.
/// Cost: one classification for each set bit at most; no allocation.
template <class Bin, class Planes>
[[nodiscard]] Side classify(const Bin& bin, const Planes& planes, std::size_t count, PlaneMask& undecided) noexcept {
    for (std::size_t i = 0; i < count && i < kMaxPlanes; ++i) {
        const PlaneMask bit = PlaneMask{1} << i;
        if (!(undecided & bit)) continue;
        const Side side = bin.classify(planes[i]);
        if (side == Side::Outside) return Side::Outside;
        if (side == Side::Inside) undecided &= ~bit;
    }
    return undecided == 0 && count <= kMaxPlanes ? Side::Inside : Side::Straddling;
}

}  // namespace osgAnalyticBin::core

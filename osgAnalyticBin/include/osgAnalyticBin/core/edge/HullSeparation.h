// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// Searches for a plane that separates a bin from the wedge inside two planes: a mixture of the two planes with weights
/// >= 0. The wedge lies on the inner side of every such mixture, so a bin outside of the mixture is outside of the
/// wedge. The search need not be exact, and needs no corners of the frustum.
/// Source: doc/theory/horizon.md, section 7.
class WedgeSearch final {
public:
    /// `reach`: no point of the bin is farther from the origin.
    WedgeSearch(const Plane& first, const Plane& second, double reach) noexcept;

    /// The present mixture, of unit length, moved inward by its own rounding. NaN when the planes cancel out.
    [[nodiscard]] Plane candidate() const noexcept;

    /// Continues with a point of the bin that is farthest inside the present mixture.
    /// Returns: false when the search is over, since the hulls meet.
    [[nodiscard]] bool learn(const glm::dvec3& point) noexcept;

private:
    std::array<Plane, 2> _planes;
    double _rounding;
    glm::dvec2 _weights{1.0, 1.0};
    // Distances to the two planes, of the last point inside the first plane, and of the last inside the second.
    std::array<glm::dvec2, 2> _points{};
    std::array<bool, 2> _known{};
};

/// The most points that a search asks for; more points rarely find a plane.
inline constexpr int kSeparationSteps = 6;

/// Bins that straddle more planes are large compared with the frustum and rarely separated from it.
inline constexpr std::size_t kSeparationPlanes = 2;

/// The search by two planes: see below.
template <class Bin>
[[nodiscard]] bool isSeparated(const Bin& bin, const Plane& first, const Plane& second) noexcept {
    // A point of the hull inside both: nothing parts it from the wedge.
    const glm::dvec3 inner = bin.hullPoint();
    if (first.distance(inner) >= 0.0 && second.distance(inner) >= 0.0) return false;
    WedgeSearch search(first, second, bin.reach());
    for (int step = 0; step < kSeparationSteps; ++step) {
        const Plane plane = search.candidate();
        const glm::dvec3 point = bin.supportPoint(plane.normal);
        if (plane.distance(point) < 0.0 && bin.classify(plane) == Side::Outside) return true;
        if (!search.learn(point)) break;
    }
    return false;
}

/// Tries to prove that a bin is beyond the edge between two planes, although no single plane proves it outside. `bin`
/// is anything with `classify`, `supportPoint`, `hullPoint` and `reach`, such as ExactGeodeticBin; `undecided` names
/// the planes that it straddles; when these are more than `mostPlanes`, the answer is false at once.
/// Guarantee: true only if no point of the bin, margin included, is inside all these planes;
/// tests: Soundness.HasNoFalseVerdict.
/// Cost: one to `kSeparationSteps` support points for each pair of planes, and a classification when it ends with
/// true; no allocation, no trigonometry.
template <class Bin, class Planes>
[[nodiscard]] bool isSeparated(const Bin& bin, const Planes& planes, std::size_t count, PlaneMask undecided,
                               std::size_t mostPlanes = kSeparationPlanes) noexcept {
    const PlaneMask asked = count < kMaxPlanes ? undecided & ((PlaneMask{1} << count) - 1) : undecided;
    const auto withoutFirst = [](PlaneMask mask) { return mask & (mask - 1); };
    if (withoutFirst(asked) == 0) return false;  // most bins that are asked about straddle one plane
    PlaneMask tooMany = asked;
    for (std::size_t i = 0; i < mostPlanes; ++i) tooMany = withoutFirst(tooMany);
    if (tooMany != 0) return false;
    const std::size_t end = count < kMaxPlanes ? count : kMaxPlanes;
    const auto isAsked = [&](std::size_t i) { return (asked >> i & 1) != 0; };
    for (std::size_t i = 0; i < end; ++i) {
        for (std::size_t j = i + 1; isAsked(i) && j < end; ++j) {
            if (isAsked(j) && isSeparated(bin, planes[i], planes[j])) return true;
        }
    }
    return false;
}

}  // namespace osgAnalyticBin::core

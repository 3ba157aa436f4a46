// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/CoveredRegion.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace osgAnalyticBin::core {

/// The directions in which an eye over a region sees past a border before its horizon. There is no terrain that the
/// occluder stands for, so what lies in these directions is not hidden.
/// Source: doc/theory/horizon.md, section 10.
class RegionalSight final {
public:
    /// `frustum`: planes in ECEF, positive inside. A border that is not in the picture up to the horizon is not passed.
    /// Requires: the eye was made for the region's ellipsoid.
    /// Returns: nullopt where nothing may be hidden: from an eye beside the region, or nearly so, and for orthographic
    /// cameras. Cost: some microseconds.
    [[nodiscard]] static std::optional<RegionalSight> from(const HorizonEye& eye, const CoveredRegion& region,
                                                           const PlaneSet& frustum) noexcept;

    /// Whether every line of sight in the frustum that meets the occluder stays over the region until it does.
    /// Guarantee: true only if it is so; tests: RegionalSight.HoldsAllLinesOfSightToTheOccluder.
    [[nodiscard]] bool holdsAll() const noexcept { return _count == 0; }

    /// Whether every line of sight in the frustum to a point of the bin, margin included, that meets the occluder stays
    /// over the region until it does.
    /// Requires: a bin prepared for the same ellipsoid.
    /// Guarantee: true only if it is so; tests: RegionalSight.HoldsNoBinThatIsSeenPastABorder.
    /// Cost: for each border that the eye sees past some 20 multiplications and a square root, twice where the first
    /// time does not decide; no trigonometry.
    [[nodiscard]] bool holds(const HorizonBin& bin) const noexcept { return holds(bin.numbers().data(), 1); }

    /// The same for the numbers of a bin that are `stride` apart.
    [[nodiscard]] bool holds(const double* numbers, std::size_t stride) const noexcept;

    /// Directions past one border, in unit space: a wedge between two half-planes that end in the line from the centre
    /// to the eye.
    struct PastBorder {
        /// @{
        /// Unit normals of the planes, toward the wedge.
        glm::dvec3 left, right;
        /// @}
        bool isReflex;  ///< the wedge is more than half a turn: what is outside is behind both planes
    };

private:
    std::array<PastBorder, 4> _borders{};
    std::size_t _count = 0;
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BoxBins.h"
#include "Camera.h"
#include "ComparisonBins.h"
#include "FrustumHull.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::paper {

/// What a tile is tested by. `Box`: the box along the axes of ECEF, another reading of "eight corners", and a sound
/// one. `Hull`: near to the truth: the exact bin, and what is beyond a face of it or a parting plane of the frustum.
enum class Method : std::size_t { Box, Corners, Paper, Quadratic, Exact, Hull };
inline constexpr std::size_t kMethods = 6;
inline constexpr std::array<const char*, kMethods> kMethodNames{"box",       "corners", "paper",
                                                                "quadratic", "exact",   "hull"};

[[nodiscard]] constexpr std::size_t indexOf(Method method) noexcept {
    return static_cast<std::size_t>(method);
}

/// The planes of a frustum and what the search for its hull needs; made once per camera.
struct Frustum {
    explicit Frustum(const Camera& camera) noexcept;

    core::PlaneSet planes;
    hull::FrustumHull hull;
};

/// A tile as every method has it.
struct TileBins {
    TileBins(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin);

    /// Where the tile lies with respect to the frustum.
    [[nodiscard]] core::Side classify(Method method, const Frustum& frustum) const noexcept;
    /// With respect to one plane. Requires: another method than Hull.
    [[nodiscard]] core::Side classify(Method method, const core::Plane& plane) const noexcept;

    rivals::BoxBin box;
    rivals::CornersBin corners;
    rivals::PaperBin paper;
    core::QuadraticOrExact quadratic;
    core::ExactGeodeticBin exact;
    hull::ReverseBin reverse;

private:
    [[nodiscard]] core::Side classify(Method method, const core::PlaneSet& planes,
                                      core::PlaneMask& undecided) const noexcept;
};

}  // namespace osgAnalyticBin::paper

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <glm/vec3.hpp>

#include <array>

namespace osgAnalyticBin::rivals {

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

}  // namespace osgAnalyticBin::rivals

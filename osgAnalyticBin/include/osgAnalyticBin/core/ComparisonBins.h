// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/AnalyticMapping.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

#include <array>

namespace osgAnalyticBin::core {

/// The rule of [JJ] as published, for comparison only: the second-order model over the box grown by a factor, its
/// range taken over nine points (the eight corners and the stationary point), no remainder.
/// Guarantee: none. It culls visible tiles and accepts invisible ones; tests: PaperBin.IsKnownToBeUnsound.
class PaperBin final {
public:
    static constexpr double kDefaultGrowth = 1.1;

    PaperBin(const AnalyticMapping& mapping, const ParameterBox& box, double growth = kDefaultGrowth) noexcept;

    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

private:
    QuadraticBin _model;
};

/// The test of the eight mapped corners, for comparison only.
/// Guarantee: none; a curved bin bulges past its corners. tests: CornersBin.IsKnownToBeUnsound.
class CornersBin final {
public:
    CornersBin(const AnalyticMapping& mapping, const ParameterBox& box) noexcept;

    [[nodiscard]] Side classify(const Plane& plane) const noexcept;

private:
    std::array<glm::dvec3, 8> _corners;
};

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/KernelData.h>

#include <cstddef>
#include <cstdint>

/// The tests of one bin against one plane: the definition that vector kernels repeat.
namespace osgAnalyticBin::core::kernels {

/// One plane of a block.
struct Lane {
    double nx, ny, nz, offset, rounding;
};

[[nodiscard]] inline Lane laneOf(const PlaneBlock& block, std::size_t i) noexcept {
    return {block.normalX[i], block.normalY[i], block.normalZ[i], block.offset[i], block.rounding[i]};
}

struct Range {
    double lower, upper;
};

enum class LaneSide : std::uint8_t { Outside, Straddling, Inside, Open };

/// The range of n.x over the bin, without margin.
[[nodiscard]] Range supportRange(const ExactBinData& bin, double nx, double ny, double nz) noexcept;

/// The rounding of the signed distance to a plane, and the margin.
[[nodiscard]] double slackOf(const ExactBinData& bin, const Lane& plane) noexcept;

/// The sphere about the bin: decides most planes.
[[nodiscard]] LaneSide sphereSide(const double (&center)[3], double reach, const Lane& plane) noexcept;

/// What follows for the planes that the sphere leaves.
[[nodiscard]] LaneSide exactSide(const ExactBinData& bin, const Lane& plane) noexcept;

/// Interval bound, then two values that are attained; Open where only the exact range tells.
[[nodiscard]] LaneSide quadraticSide(const QuadraticBinData& bin, const Lane& plane) noexcept;

}  // namespace osgAnalyticBin::core::kernels

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

/// Open: this test cannot tell.
enum class LaneSide : std::uint8_t { Outside, Straddling, Inside, Open };

/// The range of n.x over the bin, without margin.
[[nodiscard]] Range supportRange(const ExactBinData& bin, double nx, double ny, double nz) noexcept;

/// The rounding of the signed distance to a plane, and the margin.
[[nodiscard]] double slackOf(const ExactBinData& bin, const Lane& plane) noexcept;

/// The sphere about the bin: decides most planes.
[[nodiscard]] LaneSide sphereSide(const SphereData& sphere, const Lane& plane) noexcept;

/// The corners, or the model's linear part, give or take what the bin leaves them by: decides most planes that cross
/// the bin, and most of those beside it.
[[nodiscard]] LaneSide hullSide(const ExactBinData& bin, const Lane& plane) noexcept;
[[nodiscard]] LaneSide hullSide(const QuadraticBinData& bin, const Lane& plane) noexcept;
[[nodiscard]] LaneSide hullSide(const GeodeticBinData& bin, const Lane& plane) noexcept;

/// What is left: the closed form, which is never open; or the model's terms each by itself, after which only the exact
/// range of the polynomial tells.
[[nodiscard]] LaneSide fullSide(const ExactBinData& bin, const Lane& plane) noexcept;
[[nodiscard]] LaneSide fullSide(const QuadraticBinData& bin, const Lane& plane) noexcept;
[[nodiscard]] LaneSide fullSide(const GeodeticBinData& bin, const Lane& plane) noexcept;

}  // namespace osgAnalyticBin::core::kernels

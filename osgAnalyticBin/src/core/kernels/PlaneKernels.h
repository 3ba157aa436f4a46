// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Bits.h"

#include <osgAnalyticBin/core/bin/KernelData.h>

#include <cstddef>
#include <cstdint>

/// The frustum and horizon tests, compiled for several instruction sets from one source. The forms agree bit for bit.
/// Tests run in stages over all planes: sphere, coarse form, fine form, exact range. When one finds a plane outside, or
/// leaves none open, the next is left out.
namespace osgAnalyticBin::core::kernels {

/// The verdicts of the planes on a bin, one bit each; the masks do not overlap. They share one register: storing masks
/// of 32 bits separately and reading them together costs more than the whole first test.
struct PlaneSides {
    std::uint64_t both;  // outside in the lower half, inside in the upper

    [[nodiscard]] static constexpr PlaneSides of(std::uint32_t outside, std::uint32_t inside) noexcept {
        return {outside | std::uint64_t{inside} << 32};
    }
    [[nodiscard]] constexpr std::uint32_t outside() const noexcept { return static_cast<std::uint32_t>(both); }
    [[nodiscard]] constexpr std::uint32_t inside() const noexcept { return static_cast<std::uint32_t>(both >> 32); }
};

/// The planes that are undecided, and those of them that are there to be tested.
struct PlaneMasks {
    std::uint32_t undecided, tested;
};

struct PlaneKernels {
    /// One bin: its numbers, and whether they are in exact form.
    PlaneSides (*bin)(const double* numbers, bool isExact, const PlaneBlock* blocks, std::uint32_t undecided);
    void (*family)(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict);
    /// Those of the candidates that the horizon hides.
    std::uint64_t (*hidden)(const FamilyData& family, const HorizonEyeData& eye, std::uint64_t candidates);
};

/// The last stage of the quadratic form, for some planes of one bin. From one of its numbers to the next is `stride`.
[[nodiscard]] PlaneSides sidesByExactRange(const double* numbers, std::size_t stride, const PlaneBlock* blocks,
                                           std::uint32_t planes);

/// One plane and one bin at a time.
extern const PlaneKernels kScalarKernels;

/// The scalar form until static initialisation has chosen the widest that this machine runs.
extern PlaneKernels activeKernels;

/// Chooses again, after a test has changed Highway's supported targets. Not while another thread classifies.
void chooseKernels() noexcept;

}  // namespace osgAnalyticBin::core::kernels

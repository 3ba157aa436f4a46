// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/BinRows.h>
#include <osgAnalyticBin/core/KernelData.h>

#include <cstddef>
#include <cstdint>

/// One bin, or a family of bins, against all undecided planes. The scalar form is the definition; the vector form does
/// the same operations in the same order, with the planes in its lanes.
namespace osgAnalyticBin::core::kernels {

/// One bit a plane; the masks do not overlap. Two registers: masks of 32 bits that are stored one by one and read
/// together cost more than the whole first test.
struct Verdict {
    std::uint64_t sides;  // outside in the lower half, inside in the upper
    std::uint64_t open;   // quadratic bins only: what the exact range of the polynomial has to decide

    [[nodiscard]] static constexpr Verdict of(std::uint32_t outside, std::uint32_t inside,
                                              std::uint32_t open = 0) noexcept {
        return {outside | std::uint64_t{inside} << 32, open};
    }
    [[nodiscard]] constexpr std::uint32_t outside() const noexcept { return static_cast<std::uint32_t>(sides); }
    [[nodiscard]] constexpr std::uint32_t inside() const noexcept { return static_cast<std::uint32_t>(sides >> 32); }
};

/// The number of the lowest bit. Requires: one is set.
[[nodiscard]] inline unsigned firstBit(std::uint64_t bits) noexcept {
    return static_cast<unsigned>(__builtin_ctzll(bits));
}

/// The planes that are undecided, and those of them that are there to be tested.
struct PlaneMasks {
    std::uint32_t undecided, tested;
};

/// A function for each kind of bin; it takes the mask of the planes to test. Tests run in stages over all planes: the
/// sphere, the hull, the full form. When one finds a plane outside, or leaves none open, the next is left out.
struct PlaneKernels {
    Verdict (*exact)(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
    Verdict (*quadratic)(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
    Verdict (*geodetic)(const GeodeticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
    void (*family)(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict);
    std::uint64_t (*hidden)(const FamilyData& family, const HorizonEyeData& eye, std::uint64_t candidates);
};

[[nodiscard]] Verdict exactScalar(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
[[nodiscard]] Verdict quadraticScalar(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
[[nodiscard]] Verdict geodeticScalar(const GeodeticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided);
void familyScalar(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict);
[[nodiscard]] std::uint64_t hiddenScalar(const FamilyData& family, const HorizonEyeData& eye, std::uint64_t candidates);

/// The scalar form until static initialisation has chosen the widest that this machine runs: they agree bit for bit.
extern PlaneKernels activeKernels;

/// Chooses again, after a test has changed Highway's supported targets. Not while another thread classifies.
void chooseKernels() noexcept;

}  // namespace osgAnalyticBin::core::kernels

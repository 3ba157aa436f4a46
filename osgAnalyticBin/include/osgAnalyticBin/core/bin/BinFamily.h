// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/KernelData.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::core {

/// The bins of sibling tiles, tested together: a vector holds one bin in each lane. The family copies the numbers of
/// its bins into rows, one row for each number, in the order in which they are read. A slot without a bin straddles
/// every plane and is never hidden. Guarantee: the verdicts equal those of single bins, bit for bit, on every
/// instruction set and in builds without SIMD; tests: BinFamily.*. Memory: 352 bytes a slot, horizon included; the
/// slots are rounded up to a multiple of four.
class BinFamily final {
public:
    /// The most bins of a family.
    static constexpr std::size_t kMostSlots = core::kMostSlots;

    /// Makes `count` empty slots. Requires: count <= kMostSlots (asserted); more are left out.
    explicit BinFamily(std::size_t count);
    BinFamily(const BinFamily&) = delete;
    BinFamily& operator=(const BinFamily&) = delete;

    /// The number of slots, empty ones included.
    [[nodiscard]] std::size_t size() const noexcept { return _size; }
    /// The slots whose bin is in the exact form, one bit each.
    [[nodiscard]] std::uint64_t exact() const noexcept { return _data.exact; }

    /// The slots that have a bin, one bit each.
    [[nodiscard]] std::uint64_t filled() const noexcept { return _data.filled; }

    /// @{
    /// The memory that tests read, for prefetching.
    [[nodiscard]] const void* numbers() const noexcept { return _data.numbers; }
    [[nodiscard]] std::size_t bytes() const noexcept { return _lines.size() * sizeof(Line); }
    /// @}

    /// Gives the slot a bin, in the form that the bin has. Its horizon stays as it is. Requires: i < size().
    void set(std::size_t i, const ExactGeodeticBin& bin) noexcept;
    /// Likewise; the bin may be one of any mapping.
    void set(std::size_t i, const QuadraticBin& bin) noexcept;
    /// Sets the slot's data for the horizon, so that it may be hidden. Requires: i < size().
    void setHorizon(std::size_t i, const HorizonBin& bin) noexcept;
    /// Removes the slot's bin and its data for the horizon. Requires: i < size().
    void clear(std::size_t i) noexcept;

    /// Tests all slots against the planes of a set that are undecided.
    /// Guarantee: outside and insideAll are what classify(bin, planes, undecided) gives for each bin, and undecided is
    /// what it leaves of the mask, bit for bit, unless the bin is outside: then all stay undecided; tests:
    /// BinFamily.GivesTheVerdictsOfItsBins. Cost: one sphere test for all bins and planes together; the linear part, or
    /// the corners, only for planes that are open for a bin; no allocation, no trigonometry.
    void classify(const PlaneSet& planes, PlaneMask undecided, FamilyVerdict& verdict) const noexcept;

    /// Returns: the candidates that the horizon hides, with the verdicts of HorizonEye::hides() on single bins.
    /// Cost: for slots in view some ten multiplications for all lanes together; no allocation, no trigonometry.
    [[nodiscard]] std::uint64_t hiddenFrom(const HorizonEye& eye, std::uint64_t candidates) const noexcept;

    /// As core::isSeparated() of the bin. Requires: a slot in filled() (asserted). A curved bin in quadratic form is
    /// seldom found to be separated.
    [[nodiscard]] bool isSeparated(std::size_t i, const PlaneSet& planes, PlaneMask undecided) const noexcept;

private:
    // A cache line.
    struct alignas(64) Line {
        double numbers[8];
    };

    [[nodiscard]] double* slot(std::size_t i) noexcept { return _lines.data()->numbers + i; }
    void fill(std::size_t i, const double* rows, std::size_t count, bool isExact) noexcept;

    std::size_t _size;
    std::vector<Line> _lines;
    FamilyData _data;  // what the kernels read; its numbers are in the lines
};

}  // namespace osgAnalyticBin::core

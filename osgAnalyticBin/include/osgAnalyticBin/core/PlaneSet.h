// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/bin/KernelData.h>

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

/// The error of the signed distance to the plane that is due to the plane's offset; doc/theory/derivation.md, section
/// 7.
/// Returns: NaN, which decides nothing, when a number of the plane is not finite or its normal not of unit length.
[[nodiscard]] double roundingOf(const Plane& plane) noexcept;

/// A plane of some blocks.
[[nodiscard]] Plane planeOf(const PlaneBlock* blocks, std::size_t i) noexcept;

/// The planes of a frustum, laid out so that one bin is tested against four of them at once.
/// Cost: a few nanoseconds a plane to fill; no allocation. Blocks that hold no plane are never written.
class PlaneSet final {
public:
    PlaneSet() noexcept {}  // NOLINT: the blocks are left as they are

    /// Requires: size() < kMaxPlanes (asserted). An excess plane is not stored; the last plane of the set is replaced
    /// by one that decides nothing, so that no bin is Inside of the set.
    void push_back(const Plane& plane) noexcept;

    /// Planes in the set.
    [[nodiscard]] std::size_t size() const noexcept { return _size; }
    /// Requires: i < size().
    [[nodiscard]] Plane operator[](std::size_t i) const noexcept;

    /// What the kernels read: four planes a block.
    [[nodiscard]] const PlaneBlock* blocks() const noexcept { return _blocks.data(); }

    /// One bit for each plane.
    [[nodiscard]] PlaneMask all() const noexcept {
        return _size == kMaxPlanes ? ~PlaneMask{0} : (PlaneMask{1} << _size) - 1;
    }

private:
    void set(std::size_t i, const Plane& plane) noexcept;

    std::size_t _size = 0;
    std::array<PlaneBlock, kMaxPlanes / PlaneBlock::kLanes> _blocks;
};

/// Tests a bin by its numbers, see KernelData.h, against the undecided planes of a set, four at a time.
/// Returns: as classify() over single planes does, and by the same verdicts; of the planes that have the whole bin
/// inside, an Outside result need not clear all bits.
/// Guarantee: result and mask are the same, bit for bit, on every instruction set and in builds without SIMD;
/// tests: PlaneKernels.EveryTargetAgreesWithTheScalarForm.
/// Cost: for most bins one sphere test of all planes together; no allocation, no trigonometry.
[[nodiscard]] Side classifyNumbers(const double* numbers, bool isExact, const PlaneSet& planes,
                                   PlaneMask& undecided) noexcept;

/// Bins that have no such numbers, plane by plane.
template <class Bin>
[[nodiscard]] Side classify(const Bin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return classify(bin, planes, planes.size(), undecided);
}

inline double roundingOf(const Plane& plane) noexcept {
    constexpr double kRounding = 128.0 * std::numeric_limits<double>::epsilon();
    if (!isUsable(plane)) return std::numeric_limits<double>::quiet_NaN();
    // Zero for a finite offset, NaN for any other.
    const double finite = 0.0 * plane.offset;
    return kRounding * std::abs(plane.offset) + finite;
}

inline void PlaneSet::push_back(const Plane& plane) noexcept {
    assert(_size < kMaxPlanes);
    if (_size == kMaxPlanes) return set(_size - 1, {glm::dvec3(std::numeric_limits<double>::quiet_NaN()), 0.0});
    if (_size % PlaneBlock::kLanes == 0) _blocks[_size / PlaneBlock::kLanes] = PlaneBlock{};
    set(_size++, plane);
}

inline void PlaneSet::set(std::size_t i, const Plane& plane) noexcept {
    PlaneBlock& block = _blocks[i / PlaneBlock::kLanes];
    const std::size_t lane = i % PlaneBlock::kLanes;
    block.normalX[lane] = plane.normal.x;
    block.normalY[lane] = plane.normal.y;
    block.normalZ[lane] = plane.normal.z;
    block.offset[lane] = plane.offset;
    block.rounding[lane] = roundingOf(plane);
}

inline Plane planeOf(const PlaneBlock* blocks, std::size_t i) noexcept {
    const PlaneBlock& block = blocks[i / PlaneBlock::kLanes];
    const std::size_t lane = i % PlaneBlock::kLanes;
    return {{block.normalX[lane], block.normalY[lane], block.normalZ[lane]}, block.offset[lane]};
}

inline Plane PlaneSet::operator[](std::size_t i) const noexcept {
    return planeOf(blocks(), i);
}

}  // namespace osgAnalyticBin::core

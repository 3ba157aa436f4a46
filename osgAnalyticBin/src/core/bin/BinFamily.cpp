// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kernels/PlaneKernels.h"

#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>

namespace osgAnalyticBin::core {

namespace {

constexpr std::size_t kRows = row::kBinRows + row::kHorizonRows;
constexpr std::size_t kLanes = 4;
constexpr std::uint64_t kFirst = 1;

// A slot without a bin. The first stage finds it outside every plane, so that it costs no further work; its verdict is
// replaced afterwards.
void makeEmpty(double* slot, std::size_t stride) {
    for (std::size_t i = 0; i < row::kBinRows; ++i) slot[i * stride] = 0.0;
    slot[row::Reach * stride] = -std::numeric_limits<double>::infinity();
}

// An exact bin that is read from its slot only if the test of its middle is undecided.
class SlotBin {
public:
    SlotBin(const double* slot, std::size_t stride) : _slot(slot), _stride(stride) {}

    [[nodiscard]] glm::dvec3 hullPoint() const {
        return {_slot[row::CenterX * _stride], _slot[row::CenterY * _stride], _slot[row::CenterZ * _stride]};
    }
    [[nodiscard]] double reach() const { return bin().reach(); }
    [[nodiscard]] glm::dvec3 supportPoint(const glm::dvec3& direction) const { return bin().supportPoint(direction); }
    [[nodiscard]] Side classify(const Plane& plane) const { return bin().classify(plane); }

private:
    [[nodiscard]] const ExactGeodeticBin& bin() const {
        if (!_bin) _bin.emplace(_slot, _stride);
        return *_bin;
    }

    const double* _slot;
    std::size_t _stride;
    mutable std::optional<ExactGeodeticBin> _bin;
};

}  // namespace

BinFamily::BinFamily(std::size_t count) : _size(std::min(count, kMostSlots)), _data{} {
    assert(count <= kMostSlots);
    _data.stride = (_size + kLanes - 1) / kLanes * kLanes;
    _data.empty = _size == kMostSlots ? ~std::uint64_t{0} : (kFirst << _size) - 1;
    // The horizon's rows are zero: an inverse radius of zero is never hidden.
    _lines.resize(_data.stride * kRows * sizeof(double) / sizeof(Line));
    _data.numbers = reinterpret_cast<const double*>(_lines.data());
    for (std::size_t i = 0; i < _data.stride; ++i) makeEmpty(slot(i), _data.stride);
}

void BinFamily::fill(std::size_t i, const double* rows, std::size_t count, bool isExact) noexcept {
    assert(i < _size);
    for (std::size_t r = 0; r < count; ++r) slot(i)[r * _data.stride] = rows[r];
    const std::uint64_t bit = kFirst << i;
    _data.filled |= bit;
    _data.empty &= ~bit;
    _data.exact = isExact ? _data.exact | bit : _data.exact & ~bit;
}

void BinFamily::set(std::size_t i, const QuadraticBin& bin) noexcept {
    fill(i, bin.numbers().data(), bin.numbers().size(), false);
}

void BinFamily::set(std::size_t i, const ExactGeodeticBin& bin) noexcept {
    fill(i, bin.numbers().data(), bin.numbers().size(), true);
}

void BinFamily::setHorizon(std::size_t i, const HorizonBin& bin) noexcept {
    assert(i < _size);
    double* first = slot(i) + row::kBinRows * _data.stride;
    for (std::size_t r = 0; r < row::kHorizonRows; ++r) first[r * _data.stride] = bin.numbers()[r];
}

void BinFamily::clear(std::size_t i) noexcept {
    assert(i < _size);
    for (std::size_t r = 0; r < kRows; ++r) slot(i)[r * _data.stride] = 0.0;
    makeEmpty(slot(i), _data.stride);
    const std::uint64_t bit = kFirst << i;
    _data.filled &= ~bit;
    _data.empty |= bit;
    _data.exact &= ~bit;
}

bool BinFamily::isSeparated(std::size_t i, const PlaneSet& planes, PlaneMask undecided) const noexcept {
    assert(_data.filled >> i & 1);
    const double* const numbers = _data.numbers + i;
    if (_data.exact >> i & 1)
        return core::isSeparated(SlotBin(numbers, _data.stride), planes, planes.size(), undecided);
    return core::isSeparated(QuadraticBin(numbers, _data.stride), planes, planes.size(), undecided);
}

void BinFamily::classify(const PlaneSet& planes, PlaneMask undecided, FamilyVerdict& verdict) const noexcept {
    kernels::activeKernels.family(_data, planes.blocks(), {undecided, undecided & planes.all()}, verdict);
}

std::uint64_t BinFamily::hiddenFrom(const HorizonEye& eye, std::uint64_t candidates) const noexcept {
    return kernels::activeKernels.hidden(_data, eye.data(), candidates & _data.filled);
}

}  // namespace osgAnalyticBin::core

// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The tests over vectors. Multiplications and additions are not fused, so every verdict equals that of the scalar form
// bit for bit. Highway compiles this file once for each instruction set.

#include "core/Constants.h"
#include "core/kernels/OcclusionKernels.h"
#include "core/kernels/PlaneKernels.h"

#include <algorithm>
#include <cmath>

// In this order: the first of the two includes this file again.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/VectorKernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace osgAnalyticBin::core::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// In this order.
// clang-format off
#include "core/kernels/VectorNumbers.inl"
#include "core/kernels/QuadraticTest.inl"
#include "core/kernels/ExactTest.inl"
#include "core/kernels/HorizonTest.inl"
#include "core/kernels/BinStages.inl"
#include "core/kernels/FamilyStages.inl"
#include "core/kernels/OcclusionStages.inl"
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES
// clang-format on

using Wide = hn::Vec<hn::CappedTag<double, 8>>;
using Narrow = hn::Vec<hn::CappedTag<double, 4>>;

PlaneSides bin(const double* numbers, bool isExact, const PlaneBlock* blocks, std::uint32_t undecided) {
    return classifyBin<Narrow>({numbers, isExact}, blocks, undecided);
}

void family(const FamilyData& data, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict) {
    classifyFamily<Wide, Narrow>(data, blocks, masks, verdict);
}

std::uint64_t hidden(const FamilyData& data, const HorizonEyeData& eye, std::uint64_t candidates) {
    return hiddenOfFamily<Wide, Narrow>(data, eye, candidates);
}

void columns(const CellGround& ground, const CellRows& cells, double* corners, std::size_t stride) {
    columnsOf<Wide>(ground, cells, corners, stride);
}

Walls walls(const PictureData& picture, const ColumnRows& rows, double* numbers) {
    return wallsOf<Wide>(picture, rows, numbers);
}

void outline(const PictureData& picture, const BodyData& body, OutlineData& data) {
    outlineOf<Wide>(picture, body, data);
}

bool isAbove(const double* heights, std::size_t first, std::size_t last, double height) {
    return isAboveOneOf<Wide>(heights, first, last, height);
}

void raise(const PictureData& picture, const double* wall, std::size_t first, std::size_t last, double* lower,
           double* upper) {
    raiseStrips<Wide>(picture, wall, first, last, lower, upper);
}

bool covers(const double* lower, const double* upper, std::size_t first, std::size_t last, double low, double high) {
    return coversHeights<Wide>(lower, upper, first, last, low, high);
}

void choose() {
    activeKernels = {bin, family, hidden};
    activeOcclusion = {columns, walls, outline, isAbove, raise, covers};
}

}  // namespace HWY_NAMESPACE
}  // namespace osgAnalyticBin::core::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osgAnalyticBin::core::kernels {

HWY_EXPORT(choose);

void chooseKernels() noexcept {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    HWY_DYNAMIC_DISPATCH(choose)();
}

}  // namespace osgAnalyticBin::core::kernels
#endif

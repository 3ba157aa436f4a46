// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The tests over vectors. Multiplications and additions are not fused, so every verdict equals that of the scalar form
// bit for bit. Highway compiles this file once for each instruction set.

#include "core/Constants.h"
#include "core/kernels/PlaneKernels.h"

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

}  // namespace HWY_NAMESPACE
}  // namespace osgAnalyticBin::core::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osgAnalyticBin::core::kernels {

HWY_EXPORT(bin);
HWY_EXPORT(family);
HWY_EXPORT(hidden);

namespace {

struct ChooseAtStart {
    ChooseAtStart() noexcept { chooseKernels(); }
};

}  // namespace

// Constant initialisation first: whoever classifies before this file's turn gets the scalar form.
PlaneKernels activeKernels = kScalarKernels;
const ChooseAtStart kChooseAtStart;

void chooseKernels() noexcept {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    activeKernels = {&HWY_DYNAMIC_DISPATCH(bin), &HWY_DYNAMIC_DISPATCH(family), &HWY_DYNAMIC_DISPATCH(hidden)};
}

}  // namespace osgAnalyticBin::core::kernels
#endif
